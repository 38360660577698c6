// SPDX-License-Identifier: MIT
// What takes longer than the window may be asleep, on threads of its own: differences of images and
// files of them.
#include <fmt/format.h>

#include <future>

#include "framework/gui/recording_name.h"
#include "framework/gui/showing.h"
#include "framework/gui/shown_files.h"
#include "framework/gui/workbench.h"

namespace kaustik::gui {
namespace {

namespace fs = std::filesystem;

template <class T>
bool isReady(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

// Takes what is asked for off what is shown, on a thread of its own: FLIP takes long.
void Workbench::pollDifference() {
    if (isReady(difference_)) {
        bench_.difference = difference_.get();
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    if (bench_.view.comparedWith != ComparedImage::difference || difference_.valid()) return;
    const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
    if (!showing.main || !showing.subtrahend) return;
    const std::uint64_t first = showing.main->version;
    const std::uint64_t second = showing.subtrahend->version;
    if (bench_.difference && bench_.difference->isOf(first, second)) return;
    // Values of frames live as long as the result, those of kept ones as long as their owner.
    difference_ = std::async(
        std::launch::async,
        [=, result = bench_.result, one = *showing.main,
         other = *showing.subtrahend]() -> std::shared_ptr<const ImageDifference> {
            auto difference =
                std::make_shared<ImageDifference>(differenceBetween(*one.values, *other.values));
            difference->firstVersion = first;
            difference->secondVersion = second;
            Window::wake();
            return difference;
        });
}

void Workbench::pollPairs() {
    if (isReady(pairs_)) {
        bench_.pairs = pairs_.get();
        framesToDraw_ = std::max(framesToDraw_, 2);
    }
    if (!bench_.wantsPairs || pairs_.valid()) return;
    bench_.wantsPairs = false;
    struct Named {
        std::string name;
        Image irradiance;
    };
    std::vector<Named> images;
    const auto add = [&](const std::string& name, const std::shared_ptr<const ViewedTexture>& of) {
        if (of) images.push_back({name, colorsOf(of->values)});
    };
    for (const auto& texture : bench_.result->variants[0].outputTextures) {
        if (texture->name == "caustic.irradiance") add("A", texture);
    }
    for (std::size_t i = 0; i < bench_.kept.size(); ++i)
        add(fmt::format("{}", i + 1), bench_.kept[i].texture("caustic.irradiance"));
    if (bench_.reference->irradiance && hasSameView(*bench_.reference, bench_.document))
        images.push_back({"reference", *bench_.reference->irradiance});
    pairs_ = std::async(
        std::launch::async, [images = std::move(images)]() -> std::shared_ptr<const Table> {
            auto table = std::make_shared<Table>();
            table->columns = {"image", "compared with", "RMSE, W/m²", "FLIP"};
            for (std::size_t i = 0; i < images.size(); ++i) {
                for (std::size_t k = i + 1; k < images.size(); ++k) {
                    const ImageDifference difference =
                        differenceBetween(images[i].irradiance, images[k].irradiance);
                    const bool isKnown = difference.signedMean != nullptr;
                    table->rows.push_back(
                        {images[i].name, images[k].name,
                         isKnown ? fmt::format("{:.4g}", difference.rmse) : difference.problem,
                         difference.flip ? fmt::format("{:.4g}", *difference.flip) : "–"});
                }
            }
            Window::wake();
            return table;
        });
}

// Both sides of the split, as they are on the screen.
void Workbench::saveShown() {
    if (!bench_.wantsShownSaved || screenshot_.valid()) return;
    bench_.wantsShownSaved = false;
    const Showing showing = showingOf(bench_.requested(), *bench_.result, *bench_.reference);
    if (!showing.main) {
        bench_.notify("There is no image to save. " + showing.words, true, [](const Bench& bench) {
            return showingOf(bench.requested(), *bench.result, *bench.reference).main.has_value();
        });
        return;
    }
    struct Saved {
        std::string name;
        Image values;
        Image seen;
        Metadata metadata;
    };
    std::vector<Saved> images;
    const auto add = [&](const ShownImage& image, std::size_t slot, const std::string& end) {
        std::string name =
            fmt::format("{}-{}{}{}", recordingName(bench_.document.scene), image.name(),
                        image.source.empty() || !end.empty() ? "" : "-" + image.source, end);
        Image seen;
        bench_.canvas.show(slot, *image.values, image.version, image.mapping);
        seen = bench_.canvas.read(slot);
        images.push_back({std::move(name), *image.values, std::move(seen), image.metadata()});
    };
    add(*showing.main, 0, "");
    if (showing.compared) add(*showing.compared, 1, "-" + showing.compared->source);
    for (Saved& image : images) {
        for (char& c : image.name) {
            if (c == ' ' || c == '/') c = '_';
        }
    }
    const fs::path folder = recordFolder(bench_.panels);
    notifyWriting((folder / images.front().name).string() + floatImageExtension());
    screenshot_ =
        std::async(std::launch::async, [folder, images = std::move(images)]() -> std::string {
            try {
                for (const Saved& image : images) {
                    static_cast<void>(
                        writeShown(folder, image.name, image.values, image.seen, image.metadata));
                }
                return {};
            } catch (const std::exception& error) {
                return error.what();
            }
        });
}

void Workbench::saveScreenshot() {
    if (!bench_.wantsScreenshot || screenshot_.valid()) return;
    bench_.wantsScreenshot = false;
    Image image;
    image.values = window_.readPixels(image.width, image.height);
    image.channels = 3;
    const fs::path file = recordFolder(bench_.panels) / (recordingName(bench_.document.scene) +
                                                         "-window" + displayImageExtension());
    // A large picture takes longer to compress than the window may be asleep.
    screenshot_ =
        std::async(std::launch::async, [file, picture = std::move(image)]() -> std::string {
            try {
                writeImage(file, picture);
                return {};
            } catch (const std::exception& error) {
                return error.what();
            }
        });
    notifyWriting(file.string());
}

// Until finishScreenshot() says how it went.
void Workbench::notifyWriting(const std::string& file) {
    written_ = file;
    bench_.notify(fmt::format("Writing {}.", file), false, [](const Bench&) { return false; });
}

void Workbench::finishScreenshot() {
    if (!screenshot_.valid() ||
        screenshot_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return;
    }
    const std::string problem = screenshot_.get();
    if (!problem.empty()) {
        bench_.notifyUnwritten(problem);
    } else {
        bench_.notify(fmt::format("Wrote {}.", written_));
    }
    framesToDraw_ = std::max(framesToDraw_, 2);
}

}  // namespace kaustik::gui
