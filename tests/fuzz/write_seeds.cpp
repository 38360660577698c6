// SPDX-License-Identifier: MIT
// fuzz_write_seeds FOLDER: the seeds that only the program can write, a folder for each target.
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/core/files.h"
#include "framework/gui/document.h"
#include "framework/gui/state.h"
#include "framework/image/image.h"
#include "framework/reference/class_file.h"
#include "framework/reference/part_file.h"
#include "framework/run/tile_file.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    using namespace kaustik;
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];

    reference::writeReference(folder / "reference/seed.pfm", fuzz::smallReference());
    reference::Reference inClasses = fuzz::smallReference();
    for (const char* const name : {"TT", "other"})
        inClasses.classes.push_back({name, "", inClasses.irradiance, inClasses.irradianceError});
    inClasses.classes.front().pattern = "TT";
    for (const char* const target : {"layers", "classes"})
        reference::writeClasses(folder / target / "seed.exr", inClasses);
    for (const char* image :
         {"seed.pfm", "seed.stderr.pfm", "seed.caustic_view.pfm", "seed.caustic_view.stderr.pfm"}) {
        std::filesystem::remove(folder / "reference" / image);
    }

    reference::PartHead head;
    head.subject = {.key = fuzz::kSumsKey, .scene = "smallest", .request = {}};
    head.batchesOfAll = fuzz::smallSums().batchCount();
    const std::filesystem::path part = folder / "part/seed";
    reference::writePart(part, head, fuzz::smallSums());
    // Without its first line and the checksum, which the target adds.
    std::istringstream lines(readFile(part));
    std::string format;
    std::string first;
    std::string checksum;
    std::getline(std::getline(std::getline(lines, format), first), checksum);
    writeFileWhole(part,
                   first + "\n" + lines.str().substr(static_cast<std::size_t>(lines.tellg())));

    run::TileFile tile;
    tile.head.subject = {{"scene", "smallest"}};
    tile.head.tile = Shard{1, 2};
    tile.head.count = 2;
    tile.hits["_1"] = {3, "rays", {FirstHitTexels{.photon = 1}}};
    const std::filesystem::path hits = folder / "tile/seed";
    run::writeTileFile(hits, tile);
    std::istringstream tileLines(readFile(hits));
    std::getline(std::getline(std::getline(tileLines, format), first), checksum);
    writeFileWhole(
        hits, first + "\n" + tileLines.str().substr(static_cast<std::size_t>(tileLines.tellg())));

    constexpr std::size_t kChecksumBytes = 32;  // which the target adds
    const std::string sums = fuzz::smallSums().toBytes(fuzz::kSumsKey);
    writeFileWhole(folder / "cache/sums", sums.substr(0, sums.size() - kChecksumBytes));

    Image picture(3, 2, 3);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        picture.values[i] = static_cast<float>(i) / 18.0f;
    for (const char* name : {"pfm/seed.pfm", "pfm/seed.ppm", "image/seed.exr", "image/seed.png"})
        writeImage(folder / name, picture);

    nlohmann::json all = toJson(gui::SavedState());
    gui::Document document;
    document.variant.assignments = {{"trace.epsilon", "0.25"}};
    document.other = gui::Variant{"wyman2008", {{"trace", "lines"}}, {"filter.gaussian"}};
    document.edits.camera.emplace();
    document.edits.medium.emplace();
    document.edits.timeSeconds = 1.5;
    document.edits.lights["sun"] = {glm::dvec3(0, -1, 0), glm::dvec3(0, 2, 0), 0.5f};
    document.edits.waves["water"] = {scene::Wave{}};
    all["document"] = toJson(document);
    writeFileWhole(folder / "settings/workbench.json", all.dump());
}
