// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/key_list.h"

#include <QAction>
#include <QCoreApplication>
#include <QMessageBox>

#include "src/translated.h"
#include "ui/window/text_of.h"

namespace poselift {
namespace {

QString KeysOf(Action action, const KeyMap& keys) {
  QStringList shown;
  for (const std::string& key : keys.Keys(action))
    shown << QKeySequence(QString::fromStdString(key)).toString(QKeySequence::NativeText);
  return shown.join(", ");
}

}  // namespace

QString DescriptionOf(const ActionInfo& info) {
  return QString::fromStdString(Translated(info.description));
}

QString TipOf(const QString& text, Action action, const KeyMap& keys) {
  const QString shown = KeysOf(action, keys);
  return shown.isEmpty() ? text : QString("%1 (%2)").arg(text, shown);
}

QString TipOf(const ActionInfo& info, const KeyMap& keys) {
  return TipOf(DescriptionOf(info), info.action, keys);
}

void SetUp(QAction* item, const ActionInfo& info, const KeyMap& keys) {
  item->setObjectName(TextOf(info.name));
  QList<QKeySequence> sequences;
  for (const std::string& key : keys.Keys(info.action))
    sequences << QKeySequence(QString::fromStdString(key));
  item->setShortcuts(sequences);
  if (item->text().isEmpty()) item->setText(DescriptionOf(info));
  item->setToolTip(TipOf(info, keys));
}

void ShowKeyList(QWidget* window, const KeyMap& keys, bool is_live, const QString& mouse) {
  QString text = "<table>";
  for (const ActionInfo& info : Actions())
    if (info.is_live == is_live)
      text += QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                  .arg(KeysOf(info.action, keys).toHtmlEscaped(), DescriptionOf(info));
  text += "</table><p>" + mouse;
  auto* const box =
      new QMessageBox(QMessageBox::NoIcon, QCoreApplication::translate("Keys", "Keys"), text,
                      QMessageBox::Ok, window);
  box->setObjectName("keys");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

}  // namespace poselift
