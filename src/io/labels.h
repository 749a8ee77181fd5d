// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "src/labels.h"

namespace poselift {

// Reads labels of landmarks in pictures. The format is told by the content,
// never by the file's name:
//   poselift-labels  our own, version 1
//   COCO             keypoint annotations (an object with images, annotations,
//                    categories) and keypoint results (a bare list)
//   OpenPose         BODY_25 and COCO-18, versions 1.0 to 1.3; one file is one
//                    frame, a folder holds the frames <name>_keypoints.json in
//                    the order of their names
// Every name of a landmark in the result is one of FindLayout(labels.layout).
// docs/FORMATS.md says how each format's own habits (missing points, scores,
// visibility, pixel centres) are read.
//
// layout: "auto" takes what the file says, or the layout with the file's number
// of keypoints; a name of AllLayouts() is taken instead, and must fit the file.
//
// Throws InputError: file:line: the JSON path, what was found, what was wanted.
Labels ReadLabels(const std::filesystem::path& path, std::string_view layout = "auto");

// Writes poselift-labels version 1, a line for each person. Reading it back
// gives equal labels, with the places where absent landmarks were.
// Throws InputError when the file cannot be written, std::invalid_argument for
// positions that are not finite.
//
// LabelsText: the bytes of that file.
std::string LabelsText(const Labels& labels);
void WriteLabels(const Labels& labels, const std::filesystem::path& path);

}  // namespace poselift
