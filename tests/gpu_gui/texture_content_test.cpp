// SPDX-License-Identifier: MIT
// Every texture of every technique has a meaning that the workbench tells, with a name for each of
// the channels that it has.
#include "framework/gui/texture_content.h"

#include <set>

#include "framework/core/error.h"
#include "framework/gl/objects.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu_gui/floor_and_glass.h"

namespace kaustik::test {
namespace {

// A mirrored and a glass body and a medium, so that nothing is left out.
constexpr const char* kAll = R"(
name = "all"
[camera]
position = [0, 3, 4]
target = [0, 0.3, 0]
[[light]]
name = "sun"
type = "directional"
direction = [-0.4, -1, 0]
irradiance = 1000
[medium]
scattering_per_meter = [0.05, 0.05, 0.05]
absorption_per_meter = [0.01, 0.01, 0.01]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.3
position = [0, 0.6, 0]
)";

TEST(TexturesOfAllTechniques, HaveNamesUnitsAndASpace) {
    const Registry registry = registerAll();
    const scene::Scene scene = sceneFromText(std::string(kAll) + kFloorAndGlass);
    std::set<std::string> unknown;
    std::size_t count = 0;
    for (const Technique& technique : registry.techniques()) {
        RenderSettings settings;
        settings.technique = technique;
        settings.params = registry.makeParams(technique);
        settings.params.set("emit.photons", "16x16", "test");
        settings.width = 16;
        settings.height = 12;
        try {
            Renderer renderer(context(), registry, scene, std::move(settings));
            renderer.build(Purpose::picture);
            for (const std::string& name : renderer.graph().resourceNames()) {
                const graph::ResourceDesc& desc =
                    renderer.graph().descOf(renderer.graph().find(name));
                const auto* texture = std::get_if<graph::TextureDesc>(&desc);
                if (texture == nullptr) continue;
                ++count;
                const gui::TextureContent content = gui::contentOf(name, *texture);
                if (!content.isKnown) unknown.insert(name);
                const std::size_t channels =
                    content.kind == gui::ValueKind::sums
                        ? 3u
                        : static_cast<std::size_t>(gl::formatInfo(texture->format).channels);
                ASSERT_EQ(content.channels.size(), channels) << name;
                for (const gui::ChannelContent& channel : content.channels)
                    EXPECT_NE(channel.name, "") << name;
            }
        } catch (const ConfigError&) {
            // Water alone, as the technique itself says.
        }
    }
    EXPECT_GT(count, 100u);
    EXPECT_TRUE(unknown.empty()) << *unknown.begin() << " and " << unknown.size() - 1 << " more";
}

}  // namespace
}  // namespace kaustik::test
