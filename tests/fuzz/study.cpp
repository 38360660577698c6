// SPDX-License-Identifier: MIT
// What a study leaves behind, as merging reads it: the fuzzer's first line is experiment.json, and
// the second the record of its one run, whose settings are {}.
#include "framework/experiment/merge.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace kaustik;
    static const test::TemporaryFolder folder;
    static const std::filesystem::path run = folder / "study/0880955dd2ab1be95aa0733055c655b5";
    const std::string_view input = fuzz::text(bytes, size);
    const std::size_t end = std::min(input.find('\n'), input.size());
    return fuzz::tryToRead([&] {
        std::filesystem::create_directories(run);
        static_cast<void>(folder.file("study/experiment.json", input.substr(0, end)));
        std::ofstream(run / "run.json", std::ios::binary)
            << input.substr(std::min(end + 1, input.size()));
        for (const char* whole : {"report.json", "samples.json"})
            std::ofstream(run / whole) << "{}";
        static_cast<void>(experiment::mergeResults(
            {folder / "study"}, {folder / "out", true, [] { return true; }, {}}));
    });
}
