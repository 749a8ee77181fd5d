// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QLocale>

namespace poselift {

// All texts from now on, those of the core too, in the language of the desktop, where there is a
// translation: poselift_de.qm, say, in the folder of the models that ship. Needs a QApplication.
// Errors stay in English, as commands have them.
void SpeakLanguageOf(const QLocale& locale);

}  // namespace poselift
