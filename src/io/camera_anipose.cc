// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <cmath>

#include "src/input_error.h"
#include "src/io/camera_formats.h"
#include "src/io/text_scanner.h"
#include "src/io/toml_file.h"

namespace poselift {
namespace {

// One camera's table, with what a complaint about it needs.
struct Table {
  const std::filesystem::path& path;
  const toml::table& values;
  std::string name;

  InputError Error(const toml::node& node, const std::string& key, const std::string& text) const {
    return {path, static_cast<int>(node.source().begin.line),
            fmt::format("{}.{}: {}", name, key, text)};
  }

  const toml::node& At(const char* key) const {
    if (const toml::node* node = values.get(key)) return *node;
    throw InputError(path, static_cast<int>(values.source().begin.line),
                     fmt::format("{}: found no {}, wanted it", name, key));
  }

  // All numbers of a list, or of a list of lists, in order.
  std::vector<double> Numbers(const char* key) const {
    std::vector<double> numbers;
    Append(At(key), key, 0, &numbers);
    return numbers;
  }

 private:
  void Append(const toml::node& node, const char* key, int depth,
              std::vector<double>* numbers) const {
    if (const toml::array* array = node.as_array(); array && depth < 2) {
      for (const toml::node& item : *array) Append(item, key, depth + 1, numbers);
      return;
    }
    const auto number = node.value<double>();
    if (!number || depth == 0 || !(std::abs(*number) <= TextScanner::kLargestNumber))
      throw Error(node, key, "wanted a list of plain numbers");
    numbers->push_back(*number);
  }
};

void SetSize(const Table& table, Camera* camera) {
  const std::vector<double> size = table.Numbers("size");
  if (size.size() != 2 || size[0] != std::floor(size[0]) || size[1] != std::floor(size[1]))
    throw table.Error(table.At("size"), "size", "wanted two whole numbers: width, height");
  camera->width_px = static_cast<int>(size[0]);
  camera->height_px = static_cast<int>(size[1]);
}

void SetMatrix(const Table& table, Camera* camera) {
  const std::vector<double> m = table.Numbers("matrix");
  if (m.size() != 9 || m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    throw table.Error(table.At("matrix"), "matrix",
                      "wanted [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] (no skew)");
  camera->fx_px = m[0];
  camera->cx_px = m[2];
  camera->fy_px = m[4];
  camera->cy_px = m[5];
}

void SetDistortion(const Table& table, Camera* camera) {
  std::vector<double> k = table.Numbers("distortions");
  if (k.size() > 5)
    throw table.Error(table.At("distortions"), "distortions",
                      fmt::format("found {} numbers, wanted at most 5 (k1 k2 p1 p2 k3)", k.size()));
  k.resize(5, 0.0);
  camera->distortion = {.k1 = k[0], .k2 = k[1], .p1 = k[2], .p2 = k[3], .k3 = k[4]};
}

Camera CameraOf(const Table& table) {
  const toml::node* fisheye = table.values.get("fisheye");
  if (fisheye && fisheye->value_or(true))
    throw table.Error(*fisheye, "fisheye",
                      "found a fisheye lens, wanted a lens with k1 k2 p1 p2 k3 (fisheye = false)");
  Camera camera;
  SetSize(table, &camera);
  SetMatrix(table, &camera);
  if (table.values.get("distortions")) SetDistortion(table, &camera);
  if (const std::string flaw = camera.Validate(); !flaw.empty())
    throw table.Error(table.At("matrix"), "matrix", flaw);
  return camera;
}

}  // namespace

CameraList ReadAniposeCameras(const std::filesystem::path& path, const std::string& wanted) {
  const toml::table root = ReadToml(path, "a calibration of anipose");
  // toml++ sorts its keys; the file's order is that of the lines.
  std::vector<Table> tables;
  for (const auto& [key, node] : root) {
    const toml::table* values = node.as_table();
    if (!values || !values->get("matrix")) continue;
    const toml::node* name = values->get("name");
    tables.push_back(
        {path, *values, name ? name->value_or(std::string(key.str())) : std::string(key.str())});
  }
  if (tables.empty())
    throw InputError(path,
                     "found no table with a matrix, wanted a calibration of anipose; `poselift "
                     "calibrate` makes camera files");
  std::vector<size_t> order(tables.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return tables[a].values.source().begin.line < tables[b].values.source().begin.line;
  });
  CameraList list;
  for (const size_t i : order) list.names.push_back(tables[i].name);
  const size_t chosen = FindCameraName(path, list.names, wanted);
  list.chosen = {list.names[chosen], CameraOf(tables[order[chosen]])};
  return list;
}

}  // namespace poselift
