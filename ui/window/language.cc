// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/language.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QTranslator>

#include "lift/default_dictionary.h"
#include "src/translated.h"
#include "ui/window/text_of.h"

namespace poselift {
namespace {

void Install(const QLocale& locale, const QString& name, const QString& folder) {
  auto* const translator = new QTranslator(QCoreApplication::instance());
  if (translator->load(locale, name, "_", folder)) QCoreApplication::installTranslator(translator);
}

// Of the contexts that lupdate takes Translated() for the first that knows the text.
std::string TranslationOf(const char* english) {
  for (const char* context : {"poselift", "poselift::LabelSession", "poselift::LiveSession",
                              "poselift::StillFolder", "std"}) {
    const QString translated = QCoreApplication::translate(context, english);
    if (translated != english) return translated.toStdString();
  }
  return english;
}

}  // namespace

void SpeakLanguageOf(const QLocale& locale) {
  Install(locale, "qtbase", QLibraryInfo::path(QLibraryInfo::TranslationsPath));  // "Cancel"
  Install(locale, "poselift", TextOf(DefaultDictionaryPath().parent_path()));
  TranslateBy(TranslationOf);
}

}  // namespace poselift
