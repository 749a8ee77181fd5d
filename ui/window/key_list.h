// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QKeySequence>
#include <QList>
#include <QString>

#include "ui/label/key_map.h"

class QAction;
class QWidget;

namespace poselift {

QString DescriptionOf(const ActionInfo& info);
// "Play or pause (K)"
QString TipOf(const ActionInfo& info, const KeyMap& keys);
QString TipOf(const QString& text, Action action, const KeyMap& keys);

// Gives an action its name, its keys, and a tip that tells both what it does and the keys.
void SetUp(QAction* item, const ActionInfo& info, const KeyMap& keys);

// A box of all keys of a window, the camera's (is_live) or that of labelling; what the mouse does
// below. It stays until it is closed; nothing waits for it.
void ShowKeyList(QWidget* window, const KeyMap& keys, bool is_live, const QString& mouse);

}  // namespace poselift
