// SPDX-License-Identifier: MIT
#include "framework/app/commands.h"
#include "techniques/register_all.h"

int main(int argc, char** argv) {
    return kaustik::app::runCommandLine(argc, argv, kaustik::registerAll());
}
