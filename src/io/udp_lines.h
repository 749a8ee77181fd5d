// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <string_view>

namespace poselift {

// Lines of text for other programs of this machine: each is one datagram to 127.0.0.1, sent
// from an address of the loopback alone. Nobody has to listen, and sending never waits.
class UdpLines {
 public:
  // Throws InputError unless port is one of 1 to 65535, or when the system has no socket.
  explicit UdpLines(int port);
  ~UdpLines();
  UdpLines(const UdpLines&) = delete;
  UdpLines& operator=(const UdpLines&) = delete;

  // Counts a line that the system does not take: longer than 65507 bytes, or too many of them
  // on their way. Of those that it takes nobody learns whether they were read.
  void Send(std::string_view line);

  int64_t num_lost() const { return num_lost_; }

 private:
  int fd_;
  uint16_t port_;
  int64_t num_lost_ = 0;
};

}  // namespace poselift
