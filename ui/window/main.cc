// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <QApplication>
#include <QStandardPaths>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/lift_photo.h"
#include "lift/quiet_solver.h"
#include "src/capture/open_frame_source.h"
#include "src/input_error.h"
#include "ui/cli/refuse_options.h"
#include "ui/cli/tracking_options.h"
#include "ui/label/key_map.h"
#include "ui/label/label_project.h"
#include "ui/label/new_pose.h"
#include "ui/live/live_inputs.h"
#include "ui/window/language.h"
#include "ui/window/live_window.h"
#include "ui/window/main_window.h"
#include "ui/window/opening.h"
#include "ui/window/welcome.h"

namespace poselift {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string labels, layout = "body15", keys, pose;
  bool is_live = false, read_only = false;
  LiveInputs live;
  std::string out = "live";
};

bool IsCamera(const std::string& input) {
  try {
    return KindOfSource(input) == SourceKind::kCamera;
  } catch (const InputError&) {
    return false;  // who opens it says what is wrong
  }
}

// What is watched is one; of pictures and videos to be labelled nothing of this is asked.
void CheckLive(const CLI::App& app, Options* options) {
  options->is_live |= options->inputs.size() == 1 && IsCamera(options->inputs[0]);
  if (!options->is_live)
    return cli::RefuseOptions(
        app,
        {"--tags", "--camera", "--fov-deg", "--focal-px", "--pitch-deg", "--roll-deg", "--size",
         "--rate", "--format", "--set", "--fps", "--out"},
        "it is of a camera, or of a video that is watched: --live");
  if (options->inputs.size() != 1)
    throw CLI::ValidationError("--live", "wanted one camera, video or folder to watch");
  options->live.view.input = options->inputs[0];
  cli::RefuseOptions(app, {"--labels", "--read-only"},
                     "stills of a camera have theirs in the folder of --out");
  cli::RefuseViewOptions(app, options->live.view);
}

void AddOptions(CLI::App* app, Options* options) {
  app->footer(
      "Examples:\n  poselift label skier.jpg\n  poselift label --pose hero.labels.json\n"
      "  poselift label /dev/video0 --camera cam.yaml --tags tags.toml");
  auto* const pictures = app->add_option(
      "INPUT", options->inputs,
      "Pictures, folders of pictures, videos, a labels file, or a camera (/dev/video0, "
      "or 0); none: a window asks");
  auto* const pose = app->add_option(
      "--pose", options->pose,
      "A pose without a picture, to be dragged: this labels file, made if it is not there");
  pose->excludes(pictures);
  app->add_option("--labels", options->labels,
                  "The labels file (default: NAME.labels.json beside the first picture)");
  app->add_flag("--read-only", options->read_only,
                "Look at labels that are there; nothing is written")
      ->excludes(pose);
  app->add_option("--layout", options->layout, "Landmarks of new labels")->capture_default_str();
  app->add_option("--keys", options->keys, "A file that says which keys do what (TOML)");
  app->add_flag("--live", options->is_live,
                "Watch a video or a folder as if it were a camera: freeze frames, track, record");
  app->add_option(
      "--tags", options->live.tags,
      "Watched: which tag sits where (tags.toml); the person who wears them is tracked");
  app->add_option("--out", options->out, "Watched: folder of stills, their labels, and recordings")
      ->capture_default_str();
  cli::AddViewOptions(app, &options->live.view);
  app->parse_complete_callback([app, options] { CheckLive(*app, options); });
}

// Who starts without a picture chooses one, or a camera. False: nothing was chosen.
bool AskForInputs(Options* options) {
  Welcome welcome(SamplePicture());
  if (welcome.exec() != QDialog::Accepted) return false;
  options->inputs = welcome.inputs();
  if (options->inputs.size() != 1 || !IsCamera(options->inputs[0])) return true;
  options->is_live = true;
  options->live.view.input = options->inputs[0];
  options->live.view.camera = welcome.camera_file();
  options->live.tags = welcome.tags_file();
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  options->out = (std::filesystem::path(documents.toStdString()) / "poselift" / "live").string();
  return true;
}

int Watch(const Options& options, const PhotoLifter& lifter, const KeyMap& keys) {
  LiveWindow window([&] { return OpenLive(options.live, lifter); },
                    {options.live.view.input, options.out, options.layout}, lifter, keys);
  window.show();
  return QApplication::exec();
}

int Label(const Options& options, const PhotoLifter& lifter, const KeyMap& keys) {
  std::optional<OpenedLabels> opened;
  if (options.pose.empty())
    opened = OpenLabels(options.inputs, options.labels, options.layout, options.read_only);
  else
    opened.emplace(std::make_unique<LabelProject>(options.pose));
  if (!opened) return 0;
  MainWindow window(opened->project.get(), lifter, keys, std::move(opened->times));
  window.session().Do(Action::kLastChanged);  // where somebody stopped
  window.show();
  return QApplication::exec();
}

}  // namespace
}  // namespace poselift

int main(int argc, char** argv) {
  poselift::QuietSolver();
  CLI::App app{"poselift-label: label joints in pictures and see the 3D pose answer"};
  poselift::Options options;
  poselift::AddOptions(&app, &options);
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.is_live) poselift::CheckFiles(options.live);
    const poselift::Dictionary dictionary =
        poselift::ReadDictionary(poselift::DefaultDictionaryPath());
    const poselift::PhotoLifter lifter(dictionary);
    const poselift::KeyMap keys =
        options.keys.empty() ? poselift::KeyMap() : poselift::KeyMap::Read(options.keys);
    const QApplication application(argc, argv);
    poselift::SpeakLanguageOf(QLocale());
    if (!options.pose.empty())
      poselift::CreatePoseFile(options.pose, options.layout, dictionary.skeleton);
    else if (options.inputs.empty() && !poselift::AskForInputs(&options))
      return 0;
    return options.is_live ? poselift::Watch(options, lifter, keys)
                           : poselift::Label(options, lifter, keys);
  } catch (const poselift::InputError& error) {
    std::fprintf(stderr, "poselift-label: %s\n", error.what());
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "poselift-label: %s\n", error.what());
    return 1;
  }
}
