// SPDX-License-Identifier: MIT
#include "framework/gl/program_store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/gl/program.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

std::uint64_t bytesIn(const fs::path& folder) {
    std::uint64_t sum = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        sum += entry.file_size();
    return sum;
}

TEST(ProgramStore, NeverTakesMoreThanItsCapacityAndKeepsWhatWasSavedLast) {
    static_cast<void>(context());
    const fs::path folder =
        fs::temp_directory_path() / ("kaustik-programs-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const fs::path shader = folder / "nothing.comp";
    std::ofstream(shader) << "layout(local_size_x = 1) in;\nvoid main() {}\n";
    gl::ProgramCache programs;
    const GLuint program = programs.get({{shader.string()}, ""}).id();
    const auto keyOf = [](int number) { return fmt::format("{:032x}", number); };
    // What one takes; none where the driver gives no binaries.
    const fs::path first = folder / "first";
    gl::ProgramStore(first).save(program, keyOf(0));
    if (!fs::exists(first)) GTEST_SKIP() << "this driver gives no program binaries";
    const std::uint64_t each = bytesIn(first);

    constexpr std::uint64_t kRoom = 4;
    const fs::path small = folder / "small";
    for (int i = 0; i < 12; ++i) {
        // One for each program, as a process makes them.
        const gl::ProgramStore store(small, kRoom * each + each / 2);
        store.save(program, keyOf(i));
        EXPECT_EQ(bytesIn(small), std::min<std::uint64_t>(i + 1u, kRoom) * each) << i;
        EXPECT_TRUE(fs::exists(small / (keyOf(i) + ".program"))) << i;
        EXPECT_TRUE(store.load(program, keyOf(i))) << i;
    }
    fs::remove_all(folder);
}

}  // namespace
}  // namespace kaustik::test
