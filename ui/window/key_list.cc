// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/key_list.h"

#include <QAction>
#include <QCoreApplication>
#include <QMessageBox>

namespace poselift {

QString DescriptionOf(const ActionInfo& info) {
  return QCoreApplication::translate("Keys", info.description.data());
}

void SetUp(QAction* item, const ActionInfo& info, const KeyMap& keys) {
  item->setObjectName(QString::fromUtf8(info.name.data(), std::ssize(info.name)));
  QList<QKeySequence> sequences;
  for (const std::string& key : keys.Keys(info.action))
    sequences << QKeySequence(QString::fromStdString(key));
  item->setShortcuts(sequences);
  const QString text = DescriptionOf(info), shown = QString::fromStdString(keys.Text(info.action));
  if (item->text().isEmpty()) item->setText(text);
  item->setToolTip(shown.isEmpty() ? text : QString("%1 (%2)").arg(text, shown));
}

void ShowKeyList(QWidget* window, const KeyMap& keys, bool is_live, const QString& mouse) {
  QString text = "<table>";
  for (const ActionInfo& info : Actions())
    if (info.is_live == is_live)
      text += QString("<tr><td><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
                  .arg(QString::fromStdString(keys.Text(info.action)).toHtmlEscaped(),
                       DescriptionOf(info));
  text += "</table><p>" + mouse;
  auto* const box =
      new QMessageBox(QMessageBox::NoIcon, QCoreApplication::translate("Keys", "Keys"), text,
                      QMessageBox::Ok, window);
  box->setObjectName("keys");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

}  // namespace poselift
