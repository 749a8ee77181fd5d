// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "src/camera.h"

namespace poselift {

// Reads a camera from the YAML file of OpenCV's calibration programs or of ROS
// (camera_info): image_width, image_height, camera_matrix and
// distortion_coefficients (0, 4, 5 or 8 values; OpenCV's 12 or 14 when the rest
// is 0). Upper and lower case are the same, other keys are passed over.
//
// Throws InputError with file:line for what is missing, stands twice, is no
// number or implausible (Camera::Validate), for a skewed matrix and for fisheye
// and other lens models.
Camera ReadCameraYaml(const std::filesystem::path& path);

// Writes the file that OpenCV's FileStorage and ReadCameraYaml read, all digits
// kept. Throws InputError when it cannot, std::invalid_argument for a camera
// that is not valid.
void WriteCameraYaml(const Camera& camera, const std::filesystem::path& path);

// The same as ROS's camera_info (camera_calibration_parsers), one camera, not rectified.
void WriteCameraInfoYaml(const Camera& camera, const std::string& name,
                         const std::filesystem::path& path);

}  // namespace poselift
