// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <string>

namespace poselift {

// The four letters by which V4L2 names the format of a picture's bytes.
constexpr uint32_t Fourcc(char a, char b, char c, char d) {
  const auto byte = [](char letter) { return uint32_t{static_cast<unsigned char>(letter)}; };
  return byte(a) | byte(b) << 8 | byte(c) << 16 | byte(d) << 24;
}

inline constexpr uint32_t kFourccMjpg = Fourcc('M', 'J', 'P', 'G');  // a JPEG a frame
inline constexpr uint32_t kFourccJpeg = Fourcc('J', 'P', 'E', 'G');  // the same by another name
inline constexpr uint32_t kFourccYuyv =
    Fourcc('Y', 'U', 'Y', 'V');  // 4:2:2, Y U Y V for two pixels
inline constexpr uint32_t kFourccNv12 =
    Fourcc('N', 'V', '1', '2');  // 4:2:0, a plane of Y, one of UV
inline constexpr uint32_t kFourccGrey = Fourcc('G', 'R', 'E', 'Y');  // Y alone

// "MJPG"; what cannot be printed becomes '?'.
inline std::string FourccText(uint32_t fourcc) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(fourcc >> shift & 0x7f);
    text += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return text;
}

}  // namespace poselift
