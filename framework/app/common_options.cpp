// SPDX-License-Identifier: MIT
#include "framework/app/common_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace kaustik::app {

void addDeviceOption(CLI::App& command) {
    command.add_option_function<std::string>(
        "--device",
        [](const std::string& device) { ::setenv("KAUSTIK_DEVICE", device.c_str(), 1); },
        "The device: a number or a UUID from 'check', or a part of its name");
    command.add_flag_function(
        "--no-program-cache", [](std::int64_t) { ::setenv("KAUSTIK_PROGRAM_CACHE", "0", 1); },
        "Compiles all shaders anew, and keeps none");
}

void addPictureOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("--technique", options.technique, "A name from 'list techniques'")
        ->capture_default_str();
    command.add_flag("--as-published", options.isAsPublished,
                     "The technique as its paper has it to the letter, for its defaults");
    command
        .add_option("--set", options.assignments,
                    "A parameter, as name=value; any unique short form of its name will do")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--disable", options.disabled, "A pass that is not to run")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--size", options.size, "Picture size, WIDTHxHEIGHT")->capture_default_str();
    addDeviceOption(command);
}

void addOwnMeshOptions(CLI::App& command, OwnMeshOptions& options) {
    command.add_option("--on", options.on,
                       "Stands a mesh, or a .glb, into a scene that is made for it: table, pool, "
                       "room or a .toml; of a mesh alone: table");
    command.add_option("--material", options.material,
                       "What the mesh is of, by its name in that scene: glass, water, mirror, …");
    command.add_option("--up", options.up, "The axis that points up in the mesh's file: y or z");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, kSceneHelp)->capture_default_str();
    addOwnMeshOptions(command, options.own);
    addPictureOptions(command, options);
    command
        .add_option("--merge", options.merged,
                    "A .toml of settings; a later one counts more, and options more than it")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command.add_option("--time", options.time, "Time of the animation in seconds");
    command.add_flag("--gl-debug", options.glDebug,
                     "Has OpenGL check every pass, which takes time; an error then names its pass");
}

// CLI11 takes a whole number beyond 64 bits for the largest that there is.
std::string integerRangeError(const std::string& text) {
    long long number = 0;
    const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, problem] = std::from_chars(first, text.data() + text.size(), number);
    if (problem != std::errc::result_out_of_range) return "";  // else it is told as no number
    return fmt::format("{} is not a whole number from {} to {}", text,
                       std::numeric_limits<long long>::min(),
                       std::numeric_limits<long long>::max());
}

}  // namespace kaustik::app
