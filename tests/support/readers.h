// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace poselift::testing {

// A reader of what comes from outside, for tests that damage it.
struct Reader {
  std::string name;  // "bvh"
  std::string file;  // the name to give the file: "a.bvh"
  // What it reads: the bytes of a small file. Other files are written to the folder.
  std::function<std::string(const std::filesystem::path& dir)> whole;
  // Reads the file in that folder. Returns what of the header's promises does not hold, or
  // nothing; throws InputError for what the reader refuses.
  std::function<std::string(const std::filesystem::path& path)> read;
};

// Every format of every reader: motions, labels, poses, cameras, tags, boards, learned models,
// pictures, videos, the frames of a camera, the window's journal and keys, and text of the
// command line.
//
// Learned models get a right size and checksum before they are read: without these no damage
// comes further. The frames of a camera have their format in front of them (picture_readers.cc).
const std::vector<Reader>& Readers();

// Writes the bytes as reader.file into the folder and reads them, also as `poselift info` does.
// Returns and throws as reader.read.
std::string FlawOf(const Reader& reader, std::string_view bytes, const std::filesystem::path& dir);

}  // namespace poselift::testing
