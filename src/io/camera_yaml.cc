// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// cv::FileStorage is not used to read: deep nesting overflows its stack, and it
// does not take the YAML of ROS. Both write so plainly that words suffice: a
// word with a colon at its end is a key, brackets and commas are blanks.
#include "src/io/camera_yaml.h"

#include <fmt/core.h>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr size_t kMostNumbers = 14;  // OpenCV's longest list of coefficients

struct Numbers {
  int line = 0;
  std::vector<double> values;
};

struct CameraFile {
  std::optional<Numbers> image_width, image_height, camera_matrix, distortion_coefficients;
};

bool IsKey(std::string_view word) { return word.size() > 1 && word.back() == ':'; }

bool Is(std::string_view key, std::string_view name) {
  return EqualsIgnoringCase(key.substr(0, key.size() - 1), name);
}

// The numbers up to the next key, on one line or many, or as a list of dashes.
Numbers ReadNumbers(TextScanner* scanner) {
  Numbers numbers{scanner->line(), {}};
  for (;;) {
    const std::string_view next = scanner->PeekOnAnyLine();
    if (next.empty() || IsKey(next) || next == "---" || next == "...") return numbers;
    if (scanner->AtLineEnd()) scanner->NextLine();
    if (next == "-") {
      scanner->Word();
      continue;
    }
    if (numbers.values.size() == kMostNumbers)
      scanner->Fail(next, fmt::format("no more than {} numbers", kMostNumbers));
    numbers.values.push_back(scanner->Number("a number"));
  }
}

void Keep(TextScanner* scanner, std::string_view name, std::optional<Numbers>* place) {
  if (*place)
    scanner->FailAt(scanner->line(), fmt::format("found {} twice (first in line {}), wanted one",
                                                 name, (*place)->line));
  *place = ReadNumbers(scanner);
}

void RefuseOtherLenses(TextScanner* scanner) {
  const std::string_view model = scanner->Word();
  for (const std::string_view known : {"plumb_bob", "rational_polynomial", "pinhole", "none", ""})
    if (EqualsIgnoringCase(model, known)) return;
  scanner->Fail(model, "the distortion model plumb_bob or rational_polynomial");
}

CameraFile ReadFile(TextScanner* scanner) {
  CameraFile file;
  std::optional<Numbers>* matrix = nullptr;  // whose data follow
  std::string matrix_name;
  for (std::string_view word = scanner->WordOnAnyLine(); !word.empty();
       word = scanner->WordOnAnyLine()) {
    if (!IsKey(word) || Is(word, "rows") || Is(word, "cols") || Is(word, "dt")) continue;
    if (Is(word, "data")) {
      if (matrix) Keep(scanner, matrix_name, matrix);
      continue;
    }
    matrix = nullptr;
    matrix_name = word.substr(0, word.size() - 1);
    if (Is(word, "image_width")) Keep(scanner, matrix_name, &file.image_width);
    if (Is(word, "image_height")) Keep(scanner, matrix_name, &file.image_height);
    if (Is(word, "camera_matrix")) matrix = &file.camera_matrix;
    if (Is(word, "distortion_coefficients")) matrix = &file.distortion_coefficients;
    if (Is(word, "distortion_model")) RefuseOtherLenses(scanner);
  }
  return file;
}

const Numbers& Wanted(const TextScanner& scanner, const std::optional<Numbers>& numbers,
                      const char* name) {
  if (!numbers)
    throw InputError(
        scanner.file(),
        fmt::format("found no {}, wanted the YAML file of an OpenCV or ROS camera calibration",
                    name));
  return *numbers;
}

int Size(const TextScanner& scanner, const std::optional<Numbers>& numbers, const char* name) {
  const Numbers& size = Wanted(scanner, numbers, name);
  if (size.values.size() != 1 || size.values[0] != std::floor(size.values[0]) ||
      std::abs(size.values[0]) > 1e6)
    scanner.FailAt(size.line, fmt::format("{}: wanted one whole number", name));
  return static_cast<int>(size.values[0]);
}

void SetMatrix(const TextScanner& scanner, const Numbers& matrix, Camera* camera) {
  const std::vector<double>& m = matrix.values;
  if (m.size() != 9)
    scanner.FailAt(matrix.line,
                   fmt::format("camera_matrix: found {} numbers, wanted 9 (3 x 3)", m.size()));
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    scanner.FailAt(matrix.line, "camera_matrix: wanted fx 0 cx 0 fy cy 0 0 1 (no skew)");
  camera->fx_px = m[0];
  camera->cx_px = m[2];
  camera->fy_px = m[4];
  camera->cy_px = m[5];
}

void SetDistortion(const TextScanner& scanner, const Numbers& coefficients, Camera* camera) {
  std::vector<double> k = coefficients.values;
  while (k.size() > 8 && k.back() == 0) k.pop_back();
  if (!k.empty() && k.size() != 4 && k.size() != 5 && k.size() != 8)
    scanner.FailAt(coefficients.line,
                   fmt::format("distortion_coefficients: found {} numbers, wanted 0, 4, 5 or 8 "
                               "(k1 k2 p1 p2 k3 k4 k5 k6)",
                               k.size()));
  k.resize(8, 0.0);
  camera->distortion = {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]};
}

std::string Joined(const std::vector<double>& values) {
  std::string data;
  for (const double value : values) data += fmt::format("{}{}", data.empty() ? "" : ", ", value);
  return data;
}

std::string OpenCvMatrix(int rows, const std::vector<double>& values) {
  return fmt::format("!!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", rows,
                     values.size() / static_cast<size_t>(rows), Joined(values));
}

std::string RosMatrix(int rows, const std::vector<double>& values) {
  return fmt::format("\n  rows: {}\n  cols: {}\n  data: [{}]\n", rows,
                     values.size() / static_cast<size_t>(rows), Joined(values));
}

struct Lens {
  const char* model;
  std::vector<double> coefficients;
};

Lens LensOf(const Camera& camera) {
  const Distortion& d = camera.distortion;
  Lens lens{"plumb_bob", {d.k1, d.k2, d.p1, d.p2, d.k3}};
  if (d.k4 == 0 && d.k5 == 0 && d.k6 == 0) return lens;
  lens.model = "rational_polynomial";
  lens.coefficients.insert(lens.coefficients.end(), {d.k4, d.k5, d.k6});
  return lens;
}

std::vector<double> MatrixOf(const Camera& camera) {
  return {camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
}

}  // namespace

Camera ReadCameraYaml(const std::filesystem::path& path) {
  TextScanner scanner(path, {.comment = '#', .extra_blanks = ",[]{}\"'"});
  const CameraFile file = ReadFile(&scanner);
  Camera camera;
  camera.width_px = Size(scanner, file.image_width, "image_width");
  camera.height_px = Size(scanner, file.image_height, "image_height");
  const Numbers& matrix = Wanted(scanner, file.camera_matrix, "camera_matrix");
  SetMatrix(scanner, matrix, &camera);
  if (file.distortion_coefficients) SetDistortion(scanner, *file.distortion_coefficients, &camera);
  if (const std::string flaw = camera.Validate(); !flaw.empty()) scanner.FailAt(matrix.line, flaw);
  return camera;
}

void WriteCameraYaml(const Camera& camera, const std::filesystem::path& path) {
  if (const std::string flaw = camera.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  const Lens lens = LensOf(camera);
  WriteFileAtomically(
      path, fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\ncamera_matrix: {}"
                        "distortion_model: {}\ndistortion_coefficients: {}",
                        camera.width_px, camera.height_px, OpenCvMatrix(3, MatrixOf(camera)),
                        lens.model, OpenCvMatrix(1, lens.coefficients)));
}

void WriteCameraInfoYaml(const Camera& camera, const std::string& name,
                         const std::filesystem::path& path) {
  if (const std::string flaw = camera.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  const Lens lens = LensOf(camera);
  std::string plain_name;
  for (const char c : name) plain_name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  WriteFileAtomically(
      path,
      fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\ncamera_matrix:{}"
                  "distortion_model: {}\ndistortion_coefficients:{}rectification_matrix:{}"
                  "projection_matrix:{}",
                  camera.width_px, camera.height_px, plain_name.empty() ? "camera" : plain_name,
                  RosMatrix(3, MatrixOf(camera)), lens.model, RosMatrix(1, lens.coefficients),
                  RosMatrix(3, {1, 0, 0, 0, 1, 0, 0, 0, 1}),
                  RosMatrix(3, {camera.fx_px, 0, camera.cx_px, 0, 0, camera.fy_px, camera.cy_px, 0,
                                0, 0, 1, 0})));
}

}  // namespace poselift
