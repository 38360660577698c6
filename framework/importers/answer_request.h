// SPDX-License-Identifier: MIT
// What a reader process does with a request.
#pragma once

#include "framework/reading/channel.h"
#include "framework/reading/request.h"

namespace kaustik::scene {

// Reads the file in this process and sends what is in it, or the project's error about it.
void answerRequest(const reading::Request& request, reading::Channel& channel);

}  // namespace kaustik::scene
