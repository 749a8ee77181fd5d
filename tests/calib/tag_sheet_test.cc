// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the program, cairo, and pdftoppm, where poppler-utils is installed: pages are made
// pictures of 300 dpi, in which our own detector finds the tags. Checked: which tags are on the
// pages, how large they are and how far apart, page sizes, the files beside, and refusals.
#include "calib/tag_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "calib/april_grid_yaml.h"
#include "calib/body_tag_set.h"
#include "calib/tag_detector.h"
#include "src/input_error.h"
#include "src/io/body_tags_toml.h"
#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::RunProgram;

constexpr double kMmPerPixel = 25.4 / 300.0;
const std::string kHasPdftoppm = "pdftoppm -v >/dev/null 2>&1";

// Detections of all pages by id, in millimetres, of pages side by side; nothing without pdftoppm.
std::map<int, Eigen::Matrix<double, 2, 4>> TagsOfPdf(const fs::path& pdf) {
  const std::string command = "pdftoppm -r 300 -gray -png " + pdf.string() + " " +
                              (pdf.parent_path() / "page").string() + " 2>/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe): one thread
  std::map<int, Eigen::Matrix<double, 2, 4>> tags;
  TagDetector detector(TagFamily("tag36h11"), {.decimate = 2.0});
  for (const fs::directory_entry& file : fs::directory_iterator(pdf.parent_path())) {
    if (file.path().extension() != ".png") continue;
    const cv::Mat page = cv::imread(file.path().string(), cv::IMREAD_GRAYSCALE);
    for (const TagDetection& tag : detector.Detect(page)) {
      EXPECT_EQ(tags.count(tag.id), 0U) << tag.id;
      tags[tag.id] = kMmPerPixel * tag.corners_px;
    }
  }
  return tags;
}

void ExpectSize(const Eigen::Matrix<double, 2, 4>& corners_mm, double size_mm, int id) {
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR((corners_mm.col((i + 1) % 4) - corners_mm.col(i)).norm(), size_mm, 0.1) << id;
  EXPECT_NEAR(corners_mm(1, 0), corners_mm(1, 1), 0.05) << id;  // upright
  EXPECT_LT(corners_mm(0, 0), corners_mm(0, 1)) << id;
}

TEST(TagsPrintTest, TheBodySetIsTrueToATenthOfAMillimetreWithItsTagsTomlBeside) {
  const auto run = RunProgram("tags print --set body --out body.pdf");
  ASSERT_EQ(run.code, 0) << run.err;
  const BodyTags tags = ReadBodyTags(testing::ScratchDir() / "body.toml");
  EXPECT_GE(tags.tags.size(), 12U);
  if (std::system(kHasPdftoppm.c_str()) != 0)  // NOLINT(concurrency-mt-unsafe): one thread
    GTEST_SKIP() << "pdftoppm absent: install poppler-utils";
  ASSERT_EQ(RunProgram("tags print --set body --out body.pdf").code, 0);
  const auto found = TagsOfPdf(testing::ScratchDir() / "body.pdf");
  ASSERT_EQ(found.size(), tags.tags.size());
  for (const BodyTag& tag : tags.tags) {
    ASSERT_EQ(found.count(tag.id), 1U) << tag.id;
    ExpectSize(found.at(tag.id), 1e3 * tag.size_m, tag.id);
  }
}

TEST(TagsPrintTest, FoldersAreMadeAndWhatSomebodyChangedIsKept) {
  ASSERT_EQ(RunProgram("tags print --set body --out new/folder/body.pdf").code, 0);
  const auto beside = testing::ScratchDir() / "new/folder/body.toml";
  ASSERT_EQ(RunProgram("tags print --set body --out new/folder/body.pdf").code, 0);
  BodyTags tags = ReadBodyTags(beside);
  tags.tags[0].size_m = 0.1;
  WriteBodyTags(tags, beside);
  const auto run = RunProgram("tags print --set body --out new/folder/body.pdf");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("move it away"), std::string::npos) << run.err;
  EXPECT_EQ(ReadBodyTags(beside).tags[0].size_m, 0.1);
}

TEST(TagsPrintTest, TheBoardHasItsMeasuresAndKalibrsFileBeside) {
  if (std::system(kHasPdftoppm.c_str()) != 0)  // NOLINT(concurrency-mt-unsafe): one thread
    GTEST_SKIP() << "pdftoppm absent: install poppler-utils";
  ASSERT_EQ(RunProgram("tags print --set board --paper letter --out board.pdf").code, 0);
  const AprilGrid grid = ReadAprilGridYaml(testing::ScratchDir() / "board.yaml");
  const auto found = TagsOfPdf(testing::ScratchDir() / "board.pdf");
  ASSERT_EQ(found.size(), static_cast<size_t>(grid.num_tags()));
  const int top_left = grid.first_id + (grid.rows - 1) * grid.columns;
  for (const auto& [id, corners_mm] : found) {
    ExpectSize(corners_mm, 1e3 * grid.tag_size_m, id);
    const Eigen::Vector2d from_first_mm = corners_mm.col(0) - found.at(top_left).col(0);
    EXPECT_TRUE(testing::MatrixNear(from_first_mm, 1e3 * grid.TopLeft_m(id), 0.1)) << id;
  }
}

TEST(TagsPrintTest, SvgIsInMillimetresAFileAPage) {
  const auto run = RunProgram("tags print --ids 0-4,20 --size-mm 60 --out ids.svg");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "ids-1.svg\nids-2.svg\n");
}

TEST(TagSheetTest, AnSvgHasThePagesSizeAndTheTagsOutline) {
  const TagFamily family("tag36h11");
  const Paper& paper = FindPaper("letter");
  const fs::path path = testing::ScratchDir() / "one.svg";
  const auto pages = LayOutTags(family, {{.id = 3, .size_m = 0.08}}, paper);
  ASSERT_EQ(WriteTagSheet(family, pages, paper, path), std::vector<fs::path>{path});
  const std::string svg = testing::FileText(path);
  EXPECT_THAT(svg, HasSubstr("width=\"215.9mm\" height=\"279.4mm\" viewBox=\"0 0 215.9 279.4\""));
  // The top border: print at 13, 18; a cell is 10 mm.
  EXPECT_THAT(svg, HasSubstr("M 23 28 L 103 28 L 103 38 L 23 38 Z"));
}

TEST(TagSheetTest, BlocksNeitherOverlapNorLeaveThePage) {
  const TagFamily family("tag36h11");
  const Paper& paper = FindPaper("A4");
  std::vector<SheetTag> tags;
  for (int id = 0; id < 40; ++id) tags.push_back({.id = id, .size_m = 0.03 + 0.002 * (id % 20)});
  size_t num_tags = 0;
  for (const SheetPage& page : LayOutTags(family, tags, paper)) {
    std::vector<cv::Rect2d> prints;
    for (const PlacedSheetTag& placed : page.tags) {
      const double size_m = placed.tag.size_m, border_m = 0.125 * size_m;
      prints.emplace_back(placed.top_left_m.x() - border_m, placed.top_left_m.y() - border_m,
                          1.25 * size_m, 1.25 * size_m);
      EXPECT_GE(prints.back().x, 0.01);
      EXPECT_LE(prints.back().br().x, paper.width_m - 0.01);
      EXPECT_LE(prints.back().br().y, paper.height_m - 0.04);
      for (size_t k = 0; k + 1 < prints.size(); ++k)
        EXPECT_EQ((prints[k] & prints.back()).area(), 0.0);
    }
    num_tags += page.tags.size();
  }
  EXPECT_EQ(num_tags, tags.size());
}

TEST(TagSheetTest, WhatDoesNotFitOrIsUnknownIsRefused) {
  const TagFamily family("tag36h11");
  const Paper& paper = FindPaper("a4");
  EXPECT_THROW(LayOutTags(family, {{.id = 1, .size_m = 0.2}}, paper), InputError);
  EXPECT_THROW(LayOutTags(family, {{.id = 587, .size_m = 0.05}}, paper), InputError);
  EXPECT_THROW(LayOutGrid({.tag_size_m = 0.088}, paper), InputError);
  EXPECT_THROW(FindPaper("A7"), InputError);
  EXPECT_THROW(WriteTagSheet(family, {}, paper, "tags.png"), InputError);
}

TEST(TagsPrintTest, WrongUsesAreRefusedWithWhatIsWanted) {
  const auto refused = [](const std::string& arguments, const std::string& why) {
    const auto run = RunProgram("tags print --out t.pdf " + arguments);
    EXPECT_EQ(run.code, 3) << arguments;
    EXPECT_THAT(run.err, HasSubstr(why));
  };
  refused("--ids 3 --size-mm 300", "needs 381.0 x 396.0 mm, wanted at most 190.0 x 243.0 mm");
  refused("--ids 700", "wanted 0 to 586");
  for (const auto& [wrong, wanted] : {std::pair{"--ids 3-1", "wanted ids as 0-11,20"},
                                      {"--ids 1,0-2", "found 1 twice"},
                                      {"--ids ''", "wanted ids as 0-11,20"},
                                      {"--ids 1 --paper A9", "A4,Letter,A3"},
                                      {"--ids 1 --family tag99h9", "tag36h11"}}) {
    const auto run = RunProgram(std::string("tags print --out t.pdf ") + wrong);
    EXPECT_EQ(run.code, 2) << wrong;
    EXPECT_THAT(run.err, HasSubstr(wanted)) << wrong;
  }
  refused("--tags none.toml", "none.toml");
  EXPECT_EQ(RunProgram("tags print --out t.pdf").code, 2);
  EXPECT_EQ(RunProgram("tags print --out t.pdf --set body --ids 3").code, 2);
  for (const char* const ignored : {"--set body --family tag25h9", "--set body --size-mm 40",
                                    "--ids 3 --rows 2", "--tags t.toml --spacing 0.2"}) {
    const auto run = RunProgram(std::string("tags print --out t.pdf ") + ignored);
    EXPECT_EQ(run.code, 2) << ignored;
    EXPECT_THAT(run.err, HasSubstr("says nothing here")) << ignored;
  }
}

}  // namespace
}  // namespace poselift
