// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Lines sent to a real socket of this machine, to nobody, and to one that does not read.
#include "src/io/udp_lines.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "src/input_error.h"

namespace poselift {
namespace {

// Listens at a port of the loopback that the system chooses.
class Listener {
 public:
  Listener() : fd_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    ::bind(fd_, reinterpret_cast<sockaddr*>(&address_), size);
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address_), &size);
  }
  ~Listener() { ::close(fd_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return ntohs(address_.sin_port); }

  // The next line; "(none)" when there is none.
  std::string Next() const {
    std::string line(70000, '\0');
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t received = ::recvfrom(fd_, line.data(), line.size(), MSG_DONTWAIT,
                                        reinterpret_cast<sockaddr*>(&from), &size);
    if (received < 0) return "(none)";
    EXPECT_EQ(ntohl(from.sin_addr.s_addr), INADDR_LOOPBACK);
    line.resize(static_cast<size_t>(received));
    return line;
  }

 private:
  int fd_;
  sockaddr_in address_{};
};

TEST(UdpLines, AreDatagramsInOrder) {
  const Listener listener;
  UdpLines lines(listener.port());
  const std::string longest(60000, 'x');
  lines.Send("{\"a\": 1}\n");
  lines.Send(longest);
  lines.Send("last");
  EXPECT_EQ(listener.Next(), "{\"a\": 1}\n");
  EXPECT_EQ(listener.Next(), longest);
  EXPECT_EQ(listener.Next(), "last");
  EXPECT_EQ(listener.Next(), "(none)");
  EXPECT_EQ(lines.num_lost(), 0);
}

TEST(UdpLines, NobodyHasToListen) {
  int port = 0;
  {
    const Listener gone;
    port = gone.port();
  }
  UdpLines lines(port);
  for (int i = 0; i < 100; ++i) lines.Send("x");
  EXPECT_EQ(lines.num_lost(), 0);
}

TEST(UdpLines, DoNotWaitForOneThatDoesNotRead) {
  const Listener listener;
  UdpLines lines(listener.port());
  for (int i = 0; i < 1000; ++i) lines.Send(std::to_string(i) + std::string(60000, ' '));
  EXPECT_EQ(std::stoi(listener.Next()), 0);  // and later ones, as many as the system keeps
}

TEST(UdpLines, CountWhatIsTooLong) {
  const Listener listener;
  UdpLines lines(listener.port());
  lines.Send(std::string(65508, 'x'));
  lines.Send(std::string(200000, 'x'));
  EXPECT_EQ(lines.num_lost(), 2);
  lines.Send(std::string(65507, 'x'));
  EXPECT_EQ(lines.num_lost(), 2);
  EXPECT_EQ(listener.Next().size(), 65507u);
}

TEST(UdpLines, RefuseWhatIsNoPort) {
  for (const int port : {-1, 0, 65536, 70000}) EXPECT_THROW(UdpLines{port}, InputError) << port;
}

}  // namespace
}  // namespace poselift
