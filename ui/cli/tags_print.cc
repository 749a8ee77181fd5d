// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calib/april_grid_yaml.h"
#include "calib/body_tag_set.h"
#include "calib/tag_sheet.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_toml.h"
#include "src/io/mapped_file.h"
#include "src/io/text_scanner.h"
#include "ui/cli/refuse_options.h"
#include "ui/cli/tags.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string out, set, ids, tags, paper = "A4", family;
  double size_mm = 60.0, spacing = 0.3;
  int rows = 7, columns = 5;
  bool has_size = false;
};

// "0-11,20": whole numbers and ranges. At most as many as any family has.
std::vector<int> ReadIds(const std::string& text) {
  const auto fail = [&] {
    throw InputError(fmt::format("found {}, wanted ids as 0-11,20", Quoted(text)));
  };
  std::vector<int> ids;
  const char *at = text.data(), *end = text.data() + text.size();
  while (at < end) {
    int first = 0, last = 0;
    auto read = std::from_chars(at, end, first);
    if (read.ec != std::errc() || first < 0) fail();
    last = first;
    if (read.ptr < end && *read.ptr == '-') read = std::from_chars(read.ptr + 1, end, last);
    if (read.ec != std::errc() || last < first || last > 65535) fail();
    for (int id = first; id <= last; ++id) {
      if (std::find(ids.begin(), ids.end(), id) != ids.end())
        throw InputError(fmt::format("found {} twice, wanted ids that differ", id));
      ids.push_back(id);
    }
    if (read.ptr < end && *read.ptr++ != ',') fail();
    at = read.ptr;
  }
  if (ids.empty()) fail();
  return ids;
}

// For CLI11: what is wrong with them, empty when nothing is.
std::string IsIds(const std::string& text) try {
  ReadIds(text);
  return {};
} catch (const InputError& error) {
  return error.what();
}

fs::path Beside(const Options& options, const char* ending) {
  return fs::path(options.out).replace_extension(ending);
}

void Report(const std::vector<fs::path>& files, size_t num_tags, size_t num_pages) {
  for (const fs::path& file : files) std::printf("%s\n", file.c_str());
  std::fprintf(stderr,
               "poselift: %zu tags on %zu %s; print at 100 %%, then check the 100 mm scale\n",
               num_tags, num_pages, num_pages == 1 ? "page" : "pages");
}

int PrintTags(const Options& options, const std::string& family_name,
              const std::vector<SheetTag>& tags) {
  PrepareFolderOf(options.out);
  const TagFamily family(family_name);
  const Paper& paper = FindPaper(options.paper);
  const std::vector<SheetPage> pages = LayOutTags(family, tags, paper);
  Report(WriteTagSheet(family, pages, paper, options.out), tags.size(), pages.size());
  return kDone;
}

// What somebody has fitted or changed is not written over.
void RefuseToReplace(const fs::path& file, std::string_view text) {
  if (!fs::exists(file) || MappedFile(file).Bytes() == text) return;
  throw InputError(file,
                   "found a file that is another one, wanted none: move it away, or print to "
                   "another name");
}

int PrintBody(const Options& options) {
  const BodyTags tags = DefaultBodyTags();
  const fs::path beside = Beside(options, ".toml");
  RefuseToReplace(beside, BodyTagsToml(tags));
  const int code = PrintTags(options, tags.family, SheetTagsOf(tags));
  WriteBodyTags(tags, beside);
  std::printf("%s\n", beside.c_str());
  return code;
}

int PrintBoard(const Options& options) {
  AprilGrid grid{.rows = options.rows,
                 .columns = options.columns,
                 .tag_size_m = 1e-3 * (options.has_size ? options.size_mm : 24.0),
                 .spacing = options.spacing};
  if (!options.family.empty()) grid.family = options.family;
  const Paper& paper = FindPaper(options.paper);
  const std::vector<SheetPage> pages = LayOutGrid(grid, paper);
  PrepareFolderOf(options.out);
  const fs::path beside = Beside(options, ".yaml");
  RefuseToReplace(beside, AprilGridYaml(grid));
  const auto files = WriteTagSheet(TagFamily(grid.family), pages, paper, options.out);
  Report(files, static_cast<size_t>(grid.num_tags()), pages.size());
  WriteAprilGridYaml(grid, beside);
  std::printf("%s\n", beside.c_str());
  return kDone;
}

int PrintIds(const Options& options) {
  std::vector<SheetTag> tags;
  for (const int id : ReadIds(options.ids))
    tags.push_back({.id = id, .size_m = 1e-3 * options.size_mm});
  return PrintTags(options, options.family.empty() ? "tag36h11" : options.family, tags);
}

int Print(const Options& options) {
  if (options.set == "body") return PrintBody(options);
  if (options.set == "board") return PrintBoard(options);
  if (!options.ids.empty()) return PrintIds(options);
  const BodyTags tags = ReadBodyTags(options.tags, TagPlaces::kAny);
  return PrintTags(options, tags.family, SheetTagsOf(tags));
}

}  // namespace

CLI::App* AddTagsPrint(CLI::App* tags, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      tags->add_subcommand("print", "Sheets of tags at their exact size, PDF or SVG");
  command->footer(
      "A tag's size is the edge of the square between its black and its white border. Print at\n"
      "100 %, check the scale of 100 mm, glue the tags on card: bent tags are not seen.\n"
      "The body set comes with a tags.toml beside it, the board with Kalibr's target file.\n"
      "Example: poselift tags print --set body --out tags.pdf");
  command->add_option("--out", options->out, "File to write, .pdf or .svg")->required();
  auto* what = command->add_option_group("what", "What to print");
  what->add_option("--set", options->set,
                   "body: 16 tags for all segments; board: a grid to calibrate a camera with")
      ->check(CLI::IsMember({"body", "board"}));
  what->add_option("--ids", options->ids, "Ids, as 0-11,20")->check(IsIds);
  what->add_option("--tags", options->tags,
                   "The tags of a tags.toml, or tags.yaml of apriltag_ros");
  what->require_option(1);
  command->add_option("--paper", options->paper, "A4, Letter or A3")
      ->check(CLI::IsMember({"A4", "Letter", "A3"}, CLI::ignore_case))
      ->capture_default_str();
  command->add_option("--family", options->family, "Of --ids and the board [tag36h11]")
      ->check(CLI::IsMember(TagFamily::Names()));
  CLI::Option* size =
      command->add_option("--size-mm", options->size_mm, "Of --ids [60] and the board [24]")
          ->check(CLI::Range(2.0, 10000.0));
  command->add_option("--rows", options->rows, "Of the board")->capture_default_str();
  command->add_option("--columns", options->columns, "Of the board")->capture_default_str();
  command->add_option("--spacing", options->spacing, "Of the board: gap / size")
      ->capture_default_str();
  command->callback([options, size, command] {
    options->has_size = size->count() > 0;
    if (options->set == "board") return;
    RefuseOptions(*command, {"--rows", "--columns", "--spacing"}, "it is of --set board");
    if (options->ids.empty())
      RefuseOptions(*command, {"--family", "--size-mm"},
                    "the tags of a body have theirs: edit a tags.toml and print it with --tags");
  });
  *run = [options] { return Print(*options); };
  return command;
}

}  // namespace poselift::cli
