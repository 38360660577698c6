// SPDX-License-Identifier: MIT
// An X server without a screen (Xvfb) of the test's own: it ends with the test, however that ends.
#pragma once

#include <string>

#include "framework/core/process.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {

class XServer {
  public:
    // On a free display, with one screen of that many pixels, 24 bits each, 96 to the inch.
    // Throws std::runtime_error with what the server says when it doesn't start.
    XServer(int width, int height);
    ~XServer();
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;

    // For the variable DISPLAY, as ":7".
    [[nodiscard]] const std::string& display() const { return display_; }

  private:
    TemporaryFolder messages_;
    Process process_;
    std::string display_;
};

}  // namespace kaustik::test
