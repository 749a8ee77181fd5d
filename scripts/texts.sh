#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the poselift authors
#
# The texts of the window for translators: texts.sh LANGUAGE makes poselift_LANGUAGE.ts here, or brings it
# up to date.
set -euo pipefail
[[ $# -eq 1 ]] || { echo "usage: scripts/texts.sh LANGUAGE (de, pt_BR, ...)" >&2; exit 2; }
ts=$PWD/poselift_$1.ts
cd "$(dirname "$0")/.."
lupdate=$(command -v lupdate || echo "$(qmake6 -query QT_HOST_BINS)/lupdate")
# Joint to Foot: the landmarks of src/layout.cc.
aliases=$(printf ',QT_TR_NOOP+=%s' Translated ToTranslate Joint LeftOut Ear Neck Foot)
"$lupdate" ui src -I . -recursive -tr-function-alias "${aliases#,}" -ts "$ts"
