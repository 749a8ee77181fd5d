// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/udp_lines.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "src/input_error.h"

namespace poselift {
namespace {

sockaddr_in Loopback(uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

}  // namespace

UdpLines::UdpLines(int port) : port_(static_cast<uint16_t>(port)) {
  if (port < 1 || port > 65535)
    throw InputError("found the UDP port " + std::to_string(port) + ", wanted 1 to 65535");
  fd_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const sockaddr_in own = Loopback(0);  // any port
  if (fd_ < 0 || ::bind(fd_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    const int error = errno;
    if (fd_ >= 0) ::close(fd_);
    throw InputError(std::string("cannot open a UDP socket: ") + std::strerror(error));
  }
}

UdpLines::~UdpLines() { ::close(fd_); }

// Not connected: so the system does not report, at a later line, that nobody listened to one.
void UdpLines::Send(std::string_view line) {
  const sockaddr_in to = Loopback(port_);
  const ssize_t sent = ::sendto(fd_, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (sent != static_cast<ssize_t>(line.size())) ++num_lost_;
}

}  // namespace poselift
