// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <QApplication>
#include <QMessageBox>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/lift_photo.h"
#include "src/input_error.h"
#include "ui/label/key_map.h"
#include "ui/label/label_inputs.h"
#include "ui/label/label_project.h"
#include "ui/window/main_window.h"
#include "ui/window/welcome.h"

int main(int argc, char** argv) {
  CLI::App options{"poselift-label: label joints in pictures and see the 3D pose answer"};
  options.footer("Example:\n  poselift label skier.jpg");
  std::vector<std::string> inputs;
  std::string labels, layout = "body15", keys;
  options.add_option(
      "INPUT", inputs,
      "Pictures, folders of pictures, videos, or a labels file; none: a window asks");
  options.add_option("--labels", labels,
                     "The labels file (default: NAME.labels.json beside the first picture)");
  options.add_option("--layout", layout, "Landmarks of new labels")->capture_default_str();
  options.add_option("--keys", keys, "A file that says which keys do what (TOML)");
  CLI11_PARSE(options, argc, argv);
  try {
    const poselift::Dictionary dictionary =
        poselift::ReadDictionary(poselift::DefaultDictionaryPath());
    const poselift::PhotoLifter lifter(dictionary);
    const poselift::KeyMap map = keys.empty() ? poselift::KeyMap() : poselift::KeyMap::Read(keys);
    QApplication app(argc, argv);
    if (inputs.empty()) {
      poselift::Welcome welcome(poselift::SamplePicture());
      if (welcome.exec() != QDialog::Accepted) return 0;
      inputs = welcome.inputs();
    }
    poselift::LabelProject project(poselift::FindLabelsFile(inputs, labels, layout));
    poselift::MainWindow window(&project, lifter, map);
    window.show();
    return QApplication::exec();
  } catch (const poselift::InputError& error) {
    std::fprintf(stderr, "poselift-label: %s\n", error.what());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "poselift-label: %s\n", error.what());
    return 1;
  }
}
