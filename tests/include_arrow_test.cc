// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The arrow src <- calib <- lift <- ui, read from the #include lines of the
// real source tree. That a violation is found at all is checked on a planted
// tree in the scratch folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// What each folder may include of the project. The first row that a file's
// path starts with counts, so the exceptions stand first.
struct Rule {
  std::string_view folder;
  std::vector<std::string_view> may_include;
};

const std::vector<Rule>& Rules() {
  static const std::vector<Rule> kRules = {
      {"src/", {"src/"}},
      {"calib/", {"src/", "calib/"}},
      {"lift/eval/", {"src/", "lift/"}},
      {"lift/", {"src/", "lift/"}},  // and not lift/eval/, see below
      {"ui/", {"src/", "calib/", "lift/", "ui/"}},
      {"samples/", {"src/", "calib/", "lift/", "ui/", "samples/"}},
  };
  return kRules;
}

bool StartsWithAny(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return text.starts_with(prefix); });
}

// Why the file may not include this, or "".
std::string Complaint(const std::string& file, const std::string& included, bool quoted) {
  static const std::vector<std::string_view> kProject = {"src/", "calib/",   "lift/",
                                                         "ui/",  "samples/", "tests/"};
  static const std::regex kQt("^(Q[A-Z]|Qt).*");
  static const std::vector<std::string_view> kNowhere = {"opencv2/opencv.hpp", "opencv2/highgui",
                                                         "opencv2/viz"};
  static const std::vector<std::string_view> kNotInHeaders = {"ceres/", "CLI/", "hnswlib/",
                                                              "nlohmann/json.hpp"};
  const bool is_header = file.ends_with(".h");
  if (StartsWithAny(included, kNowhere)) return "is never included";
  if (is_header && StartsWithAny(included, kNotInHeaders)) return "stays out of headers";
  if (!file.starts_with("ui/window/") && std::regex_match(included, kQt))
    return "is for ui/window alone";
  if (!StartsWithAny(included, kProject))
    return quoted ? "is not named from the project's root" : "";
  if (included.starts_with("lift/eval/") && !file.starts_with("lift/eval/") &&
      !file.starts_with("ui/"))
    return "knows the truth";
  if (included.starts_with("src/testing/") && !file.starts_with("src/testing/") &&
      !file.starts_with("ui/"))
    return "makes up pictures for tests";
  for (const Rule& rule : Rules())
    if (file.starts_with(rule.folder))
      return StartsWithAny(included, rule.may_include) ? "" : "is against the arrow";
  return "";
}

struct Scan {
  std::vector<std::string> violations;  // "file:line: include complaint"
  int num_files = 0;
};

void ScanFile(const fs::path& root, const fs::path& path, Scan* scan) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*(["<])([^">]+)[">].*)");
  const std::string file = fs::relative(path, root).generic_string();
  std::ifstream stream(path);
  ASSERT_TRUE(stream) << path;
  ++scan->num_files;
  std::string line;
  std::smatch match;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!std::regex_match(line, match, kInclude)) continue;
    const std::string complaint = Complaint(file, match[2], match[1] == "\"");
    if (!complaint.empty())
      scan->violations.push_back(file + ":" + std::to_string(number) + ": " + match[2].str() + " " +
                                 complaint);
  }
}

Scan ScanTree(const fs::path& root) {
  Scan scan;
  for (const char* folder : {"src", "calib", "lift", "ui", "samples"}) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cc")
        ScanFile(root, entry.path(), &scan);
  }
  return scan;
}

// The one include line as the only file of a tree.
std::vector<std::string> Planted(const std::string& file, const std::string& line) {
  const fs::path root = testing::ScratchDir() / "tree";
  fs::remove_all(root);
  fs::create_directories((root / file).parent_path());
  std::ofstream(root / file) << line << "\n";
  return ScanTree(root).violations;
}

TEST(IncludeArrow, HoldsInTheSourceTree) {
  const Scan scan = ScanTree(testing::SourcePath(""));
  EXPECT_THAT(scan.violations, IsEmpty());
  EXPECT_GT(scan.num_files, 20);
}

TEST(IncludeArrow, FindsWhatGoesAgainstIt) {
  EXPECT_THAT(Planted("src/a.cc", "#include \"lift/b.h\""),
              ElementsAre("src/a.cc:1: lift/b.h is against the arrow"));
  EXPECT_THAT(Planted("src/io/a.h", "  #  include <calib/b.h>"), SizeIs(1));
  EXPECT_THAT(Planted("calib/a.cc", "#include \"lift/b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("lift/ik/a.cc", "#include \"calib/b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("lift/a.cc", "#include \"ui/cli/b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("ui/cli/a.cc", "#include \"tests/support/b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("ui/cli/a.cc", "#include \"samples/b.h\""), SizeIs(1));
}

TEST(IncludeArrow, HidesTheTruthFromTheLifter) {
  EXPECT_THAT(Planted("lift/lifter.cc", "#include \"lift/eval/error.h\""),
              ElementsAre("lift/lifter.cc:1: lift/eval/error.h knows the truth"));
  EXPECT_THAT(Planted("lift/eval/a.cc", "#include \"lift/eval/error.h\""), IsEmpty());
  EXPECT_THAT(Planted("ui/cli/evaluate.cc", "#include \"lift/eval/error.h\""), IsEmpty());
}

TEST(IncludeArrow, KeepsTheRendererOutOfTheLibraries) {
  EXPECT_THAT(Planted("src/a.cc", "#include \"src/testing/studio.h\""), SizeIs(1));
  EXPECT_THAT(Planted("calib/a.cc", "#include \"src/testing/studio.h\""), SizeIs(1));
  EXPECT_THAT(Planted("lift/a.cc", "#include \"src/testing/studio.h\""), SizeIs(1));
  EXPECT_THAT(Planted("src/testing/a.cc", "#include \"src/testing/studio.h\""), IsEmpty());
  EXPECT_THAT(Planted("ui/cli/evaluate.cc", "#include \"src/testing/studio.h\""), IsEmpty());
  EXPECT_THAT(Planted("src/testing/a.cc", "#include \"calib/tag_family.h\""), SizeIs(1));
}

TEST(IncludeArrow, KeepsHeavyAndWindowLibrariesInTheirPlaces) {
  EXPECT_THAT(Planted("lift/a.h", "#include <ceres/problem.h>"), SizeIs(1));
  EXPECT_THAT(Planted("lift/a.cc", "#include <ceres/problem.h>"), IsEmpty());
  EXPECT_THAT(Planted("ui/cli/a.h", "#include <CLI/App.hpp>"), SizeIs(1));
  EXPECT_THAT(Planted("lift/a.h", "#include <hnswlib/hnswlib.h>"), SizeIs(1));
  EXPECT_THAT(Planted("src/a.h", "#include <nlohmann/json.hpp>"), SizeIs(1));
  EXPECT_THAT(Planted("src/a.cc", "#include <opencv2/highgui.hpp>"), SizeIs(1));
  EXPECT_THAT(Planted("src/a.cc", "#include <opencv2/opencv.hpp>"), SizeIs(1));
  EXPECT_THAT(Planted("ui/cli/a.cc", "#include <QImage>"), SizeIs(1));
  EXPECT_THAT(Planted("ui/window/a.cc", "#include <QImage>"), IsEmpty());
}

TEST(IncludeArrow, WantsProjectIncludesFromTheRoot) {
  EXPECT_THAT(Planted("src/a.cc", "#include \"b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("src/a.cc", "#include \"../lift/b.h\""), SizeIs(1));
  EXPECT_THAT(Planted("src/a.cc", "#include \"src/b.h\""), IsEmpty());
}

}  // namespace
}  // namespace poselift
