// SPDX-License-Identifier: MIT
// Sends images to a running tev, or to another viewer that speaks its protocol (messages over TCP:
// length, kind, then what the kind says, little-endian; tev's src/Ipc.cpp).
#pragma once

#include <string>

#include "framework/image/image.h"

namespace kaustik {

class TevClient {
  public:
    // `address`: "HOST:PORT", "HOST" or "": 127.0.0.1 and 14158 where it does not say. Throws
    // ConfigError for what is no address, IoError where there is no answer.
    explicit TevClient(const std::string& address);
    ~TevClient();
    TevClient(const TevClient&) = delete;
    TevClient& operator=(const TevClient&) = delete;

    // Shows the image, rows from the top, under a name; one of that name is replaced. Throws
    // IoError where the connection is lost.
    void show(const std::string& name, const Image& image);

  private:
    void send(const std::string& message);

    std::string address_;
    int socket_ = -1;
};

}  // namespace kaustik
