// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace poselift::cli {

// A kind of file that `info` can tell and describe. To add one: a row in the
// table of recognisers.cc.
struct Recogniser {
  std::string_view kind;  // "BVH motion"
  // By the ending of the name and the first bytes (up to 4 KiB) of the file;
  // none of a directory.
  bool (*is_it)(const std::filesystem::path& path, std::string_view head);
  // What is in it, in the order to print; names carry the unit (duration_s).
  // Reads the whole file; throws InputError when it is malformed.
  nlohmann::ordered_json (*describe)(const std::filesystem::path& path);
};

// The first that says yes describes the file.
std::span<const Recogniser> Recognisers();

// Motion files: recognise_motion.cc.
bool IsBvh(const std::filesystem::path& path, std::string_view head);
bool IsAmc(const std::filesystem::path& path, std::string_view head);
bool IsAsf(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeBvh(const std::filesystem::path& path);
nlohmann::ordered_json DescribeAmc(const std::filesystem::path& path);
nlohmann::ordered_json DescribeAsf(const std::filesystem::path& path);

// Learned models: recognise_model.cc.
bool IsDictionary(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeDictionary(const std::filesystem::path& path);

bool IsMotionCodebook(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeMotionCodebook(const std::filesystem::path& path);

// The tags that a person wears: recognise_tags.cc.
bool IsBodyTags(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeBodyTags(const std::filesystem::path& path);

// Kalibr's target file of an AprilTag grid: recognise_tags.cc.
bool IsAprilGrid(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeAprilGrid(const std::filesystem::path& path);

bool IsCamera(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeCamera(const std::filesystem::path& path);

bool IsImage(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeImage(const std::filesystem::path& path);

// recognise_video.cc.
bool IsVideoOfFrames(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeVideo(const std::filesystem::path& path);
bool IsPictureFolder(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribePictureFolder(const std::filesystem::path& path);

// What commands write with --json, and angles.csv: recognise_report.cc.
bool IsReport(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeReport(const std::filesystem::path& path);
bool IsAnglesCsv(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeAnglesCsv(const std::filesystem::path& path);

bool IsPoses(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribePoses(const std::filesystem::path& path);

// True joints for `lift --truth`: recognise_results.cc.
bool IsTruth(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeTruth(const std::filesystem::path& path);

// Any JSON, and a directory: the labels' reader knows what is wrong with it.
bool IsLabels(const std::filesystem::path& path, std::string_view head);
nlohmann::ordered_json DescribeLabels(const std::filesystem::path& path);

// Whether the name ends so, in upper or lower case: HasEnding("A.BVH", ".bvh").
bool HasEnding(const std::filesystem::path& path, std::string_view ending);

}  // namespace poselift::cli
