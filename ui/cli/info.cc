// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "ui/cli/command.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::vector<std::string> files;
  std::string json;
};

// Names in a file may be no UTF-8.
std::string Text(const Json& value, int indent = -1) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string ReadHead(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(path.string(), "found no such file");
  if (error) throw InputError(path.string(), "cannot read it: " + error.message());
  if (std::filesystem::is_directory(status)) return {};
  if (!std::filesystem::is_regular_file(status))  // a pipe may never end
    throw InputError(path.string(), "is no ordinary file; wanted one, or a folder of OpenPose's");
  constexpr std::streamsize kHeadBytes = 4096;
  std::string head(kHeadBytes, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open())
    throw InputError(path.string(), std::string("cannot open it: ") + std::strerror(errno));
  file.read(head.data(), kHeadBytes);
  if (file.bad()) throw InputError(path.string(), "cannot read it");
  head.resize(static_cast<size_t>(file.gcount()));
  return head;
}

Json Describe(const std::string& path) {
  const std::string head = ReadHead(path);
  for (const Recogniser& recogniser : Recognisers()) {
    if (!recogniser.is_it(path, head)) continue;
    Json facts = {{"file", path}, {"kind", recogniser.kind}};
    facts.update(recogniser.describe(path));
    return facts;
  }
  std::string kinds;
  for (const Recogniser& recogniser : Recognisers())
    kinds.append(kinds.empty() ? "" : ", ").append(recogniser.kind);
  throw InputError(path, "found a file of no kind I know, wanted one of: " + kinds);
}

void Print(const Json& facts) {
  for (const auto& [name, value] : facts.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : Text(value);
    if (name == "file")
      std::printf("%s\n", text.c_str());
    else
      std::printf("  %-20s %s\n", name.c_str(), text.c_str());
  }
}

// One unreadable file does not hide the others.
int Info(const InfoOptions& options) {
  Json report = {{"command", "info"}, {"files", Json::array()}};
  int code = kDone;
  for (const std::string& path : options.files) {
    try {
      report["files"].push_back(Describe(path));
      Print(report["files"].back());
    } catch (const InputError& error) {
      std::fprintf(stderr, "poselift: %s\n", error.what());
      report["files"].push_back({{"file", path}, {"error", error.what()}});
      code = kUnreadableInput;
    }
  }
  if (!options.json.empty()) WriteFileAtomically(options.json, Text(report, 2) + "\n");
  return code;
}

}  // namespace

CLI::App* AddInfo(CLI::App* app, Run* run) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app->add_subcommand("info", "Say what is in a file");
  command->add_option("FILE", options->files, "Files of any kind that poselift reads")->required();
  command->add_option("--json", options->json, "Write the same facts to this file");
  command->footer("Example: poselift info walk.bvh labels.json photo.jpg --json facts.json");
  *run = [options] { return Info(*options); };
  return command;
}

}  // namespace poselift::cli
