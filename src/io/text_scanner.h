// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace poselift {

// The whole of a text file. Throws InputError for what is no readable text: a
// directory, no permission, more than 4 GiB, binary (a zero byte).
std::string ReadTextFile(const std::filesystem::path& path);

// Reads the text formats of motion files word by word, line by line, and knows
// the line for its errors. Words stand between blanks (space, tab, carriage
// return and what the format adds); a comment reaches from its character, at
// the start of a word, to the end of the line. Numbers are plain C numbers in
// any locale. Nothing is allocated per word.
class TextScanner {
 public:
  struct Format {
    char comment = '\0';            // '\0': the format has no comments
    std::string_view extra_blanks;  // e.g. "()"
  };
  // No length in any unit and no angle in degrees is larger.
  static constexpr double kLargestNumber = 1e9;

  TextScanner(const std::filesystem::path& path, const Format& format);

  // The next word of this line; empty at its end.
  std::string_view Word();
  // The next word of this or a later line; empty at the end of the file.
  std::string_view WordOnAnyLine();
  std::string_view PeekOnAnyLine();
  // Moves to the next line that has a word; false at the end of the file.
  bool NextLine();
  bool AtLineEnd();
  // Throws unless the line has ended.
  void ExpectLineEnd();

  // The next word of this line as a number. `wanted` completes the sentence
  // 'found "x", wanted ...'. NaN, infinities and numbers beyond kLargestNumber
  // are refused; numbers too small for a double are 0.
  double Number(std::string_view wanted);
  // The same, and inf is a number (ASF limits).
  double NumberOrInfinity(std::string_view wanted);

  // Throws InputError: file:line: found "word", wanted ...
  [[noreturn]] void Fail(std::string_view found, std::string_view wanted) const;
  [[noreturn]] void FailAt(int line, const std::string& message) const;

  int line() const { return line_; }
  const std::string& file() const { return file_; }

 private:
  bool IsBlank(char c) const { return blank_[static_cast<unsigned char>(c)]; }
  void SkipBlanks();
  double NumberFromWord(std::string_view word, std::string_view wanted) const;

  std::string file_;
  std::string text_;
  std::array<bool, 256> blank_{};
  char comment_;
  const char* at_;
  const char* end_;
  int line_ = 1;
};

// A word as it can stand in a message: shortened, without control characters.
std::string Quoted(std::string_view word);

bool EqualsIgnoringCase(std::string_view a, std::string_view b);

}  // namespace poselift
