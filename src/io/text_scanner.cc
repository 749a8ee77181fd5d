// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/text_scanner.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr off_t kLargestFile = off_t{4} << 30;

char LowerAscii(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Reads until the end, for the size that stat says may be wrong or unknown.
std::string ReadAll(int fd, const std::string& name, off_t expected_size) {
  std::string text;
  text.resize(static_cast<size_t>(expected_size) + 1);
  size_t used = 0;
  for (;;) {
    const ssize_t count = ::read(fd, text.data() + used, text.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(name, std::string("cannot read it: ") + std::strerror(errno));
    if (count == 0) break;
    used += static_cast<size_t>(count);
    if (static_cast<off_t>(used) > kLargestFile)
      throw InputError(name, "found more than 4 GiB, wanted a text file");
    if (used == text.size()) text.resize(2 * used);
  }
  text.resize(used);
  return text;
}

// from_chars says "out of range" for 1e999 and for 1e-999 alike.
bool IsTooSmallForDouble(std::string_view digits) {
  const size_t exponent = digits.find_first_of("eE");
  if (exponent != std::string_view::npos) return digits.substr(exponent + 1).starts_with('-');
  const std::string_view whole = digits.substr(0, digits.find('.'));
  return whole.find_first_not_of("-0") == std::string_view::npos;
}

}  // namespace

std::string ReadTextFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw InputError(name, std::string("cannot open it: ") + std::strerror(errno));
  struct Closer {
    int fd;
    ~Closer() { ::close(fd); }
  } closer{fd};
  struct stat status {};
  if (::fstat(fd, &status) != 0)
    throw InputError(name, std::string("cannot read it: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(name, "found a directory, wanted a file");
  if (status.st_size > kLargestFile)
    throw InputError(name, "found more than 4 GiB, wanted a text file");
  std::string text = ReadAll(fd, name, status.st_size);
  if (text.find('\0') != std::string::npos)
    throw InputError(name, "found binary data, wanted a text file");
  return text;
}

TextScanner::TextScanner(const std::filesystem::path& path, const Format& format)
    : file_(path.string()), text_(ReadTextFile(path)), comment_(format.comment) {
  for (const char c : std::string_view(" \t\r\f\v")) blank_[static_cast<unsigned char>(c)] = true;
  for (const char c : format.extra_blanks) blank_[static_cast<unsigned char>(c)] = true;
  at_ = text_.data();
  end_ = at_ + text_.size();
  if (std::string_view(text_).starts_with("\xEF\xBB\xBF")) at_ += 3;
}

void TextScanner::SkipBlanks() {
  while (at_ != end_ && IsBlank(*at_)) ++at_;
  if (comment_ == '\0' || at_ == end_ || *at_ != comment_) return;
  const void* newline = std::memchr(at_, '\n', static_cast<size_t>(end_ - at_));
  at_ = newline ? static_cast<const char*>(newline) : end_;
}

std::string_view TextScanner::Word() {
  SkipBlanks();
  const char* start = at_;
  while (at_ != end_ && *at_ != '\n' && !IsBlank(*at_)) ++at_;
  return {start, static_cast<size_t>(at_ - start)};
}

bool TextScanner::AtLineEnd() {
  SkipBlanks();
  return at_ == end_ || *at_ == '\n';
}

bool TextScanner::NextLine() {
  const void* newline = std::memchr(at_, '\n', static_cast<size_t>(end_ - at_));
  at_ = newline ? static_cast<const char*>(newline) : end_;
  for (SkipBlanks(); at_ != end_ && *at_ == '\n'; SkipBlanks()) {
    ++at_;
    ++line_;
  }
  return at_ != end_;
}

std::string_view TextScanner::WordOnAnyLine() {
  if (AtLineEnd() && !NextLine()) return {};
  return Word();
}

std::string_view TextScanner::PeekOnAnyLine() {
  const char* at = at_;
  const int line = line_;
  const std::string_view word = WordOnAnyLine();
  at_ = at;
  line_ = line;
  return word;
}

void TextScanner::ExpectLineEnd() {
  if (!AtLineEnd()) Fail(Word(), "the end of the line");
}

double TextScanner::Number(std::string_view wanted) {
  SkipBlanks();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(at_, end_, value);
  const bool whole_word = stop == end_ || *stop == '\n' || IsBlank(*stop);
  if (error == std::errc() && whole_word && std::abs(value) <= kLargestNumber) {
    at_ = stop;
    return value;
  }
  return NumberFromWord(Word(), wanted);
}

double TextScanner::NumberOrInfinity(std::string_view wanted) {
  SkipBlanks();
  const char* start = at_;
  const std::string_view word = Word();
  const bool negative = word.starts_with('-');
  const std::string_view size = word.substr(negative || word.starts_with('+') ? 1 : 0);
  if (EqualsIgnoringCase(size, "inf") || EqualsIgnoringCase(size, "infinity"))
    return negative ? -HUGE_VAL : HUGE_VAL;
  at_ = start;
  return Number(wanted);
}

double TextScanner::NumberFromWord(std::string_view word, std::string_view wanted) const {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error == std::errc::invalid_argument ||
      stop != digits.data() + digits.size())
    Fail(word, wanted);
  if (error == std::errc::result_out_of_range && IsTooSmallForDouble(digits)) return 0.0;
  if (error != std::errc() || !std::isfinite(value) || std::abs(value) > kLargestNumber)
    Fail(word, std::string(wanted) + " (a finite number below 1e9)");
  return value;
}

void TextScanner::Fail(std::string_view found, std::string_view wanted) const {
  FailAt(line_, "found " + (found.empty() ? std::string("the end of the line") : Quoted(found)) +
                    ", wanted " + std::string(wanted));
}

void TextScanner::FailAt(int line, const std::string& message) const {
  throw InputError(file_, line, message);
}

std::string Quoted(std::string_view word) {
  constexpr size_t kLongest = 40;
  std::string quoted = "\"";
  for (const char c : word.substr(0, kLongest)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (word.size() > kLongest ? "...\"" : "\"");
}

bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return LowerAscii(x) == LowerAscii(y); });
}

}  // namespace poselift
