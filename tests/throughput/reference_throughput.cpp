// SPDX-License-Identifier: MIT
// How many rays a second the light tracer follows, and how many bare rtcIntersect1 does on the very
// same rays, in one run and on one thread: reference_throughput [SCENE [PHOTONS [REPEATS]]]. Takes
// the best of the repeats of each, alternating.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/scene/files/scene_file.h"

namespace {

using namespace kaustik;
using namespace kaustik::reference;

struct BareRay {
    glm::vec3 origin;
    glm::vec3 direction;
    float tfar;
};

// Notes every ray that the light tracer casts for a photon.
struct RayRecorder {
    const Eye& eye;
    std::vector<BareRay>& rays;

    void add(const glm::dvec3& origin, const glm::dvec3& direction, double tfar) {
        rays.push_back({glm::vec3(origin), glm::vec3(direction), static_cast<float>(tfar)});
    }
    void emitted(const glm::dvec3&) {}
    void absorbed(const glm::dvec3&) {}
    void lost(unsigned, const glm::dvec3&) {}
    void passed(const PhotonState&, double, const glm::dvec3&, Random&) {}
    void leftScene(const PhotonState& photon) { addPath(photon); }
    void hitSurface(const SurfaceHit&, const PhotonState& photon) {
        if (photon.interactions > 0) addPath(photon);
    }
    void addPath(const PhotonState& photon) {
        add(photon.origin, photon.direction, std::numeric_limits<double>::infinity());
    }
    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        addPath(photon);
        if (!eye.project(hit.position).onScreen ||
            !eye.seesSide(hit.position, hit.geometricNormal, photon.direction)) {
            return;
        }
        add(hit.position, eye.position() - hit.position, 1.0);
    }
};

std::vector<BareRay> recordRays(const EmbreeScene& scene, const LightTraceSettings& settings) {
    std::vector<BareRay> rays;
    const LightSampler sampler(scene, settings.photonsPerBatch);
    const Eye eye(scene, settings.width, settings.height);
    const LightTransport transport(scene, settings.filter);
    RayRecorder recorder{eye, rays};
    for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
        Random random(settings.seed, 0, i);
        const EmittedPhoton emitted = sampler.sample(i, random);
        const PhotonState photon = stateOf(emitted);
        recorder.addPath(photon);
        transport.follow(photon, emitted.reach, random, recorder);
    }
    return rays;
}

// Of this thread's processor, so that other programs on the machine do not count.
double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double bareSeconds(RTCScene scene, const std::vector<BareRay>& rays) {
    const double start = processorSeconds();
    QueryContext context;
    initQueryContext(context);
    std::size_t hits = 0;
    for (const BareRay& ray : rays) {
        RTCRayHit query{};
        query.ray.org_x = ray.origin.x;
        query.ray.org_y = ray.origin.y;
        query.ray.org_z = ray.origin.z;
        query.ray.dir_x = ray.direction.x;
        query.ray.dir_y = ray.direction.y;
        query.ray.dir_z = ray.direction.z;
        query.ray.tfar = ray.tfar;
        query.ray.mask = 0xffffffffu;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        findFirstHit(scene, context, query);
        hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
    const double time = processorSeconds() - start;
    if (hits == 0) fmt::print("No ray hit anything.\n");
    return time;
}

void measure(const std::string& name, std::uint64_t photons, int repeats) {
    const scene::Scene scene = scene::loadScene(name);
    const EmbreeScene embree(scene);
    // The same scene without filters, as anybody would build it.
    const EmbreeScene bare(scene, EmbreeScene::Filters::none);
    LightTraceSettings settings;
    settings.photonsPerBatch = photons;
    const std::vector<BareRay> rays = recordRays(embree, settings);
    BatchResult result;
    result.values.resize(std::size_t{800} * 600 * 3 * 2);
    double bestBare = std::numeric_limits<double>::infinity();
    double bestTracer = bestBare;
    for (int i = 0; i < repeats; ++i) {
        bestBare = std::min(bestBare, bareSeconds(bare.everything(), rays));
        result.clear();
        const double start = processorSeconds();
        lightTraceBatch(embree, settings, 0, result);
        bestTracer = std::min(bestTracer, processorSeconds() - start);
    }
    const double bareRate = static_cast<double>(rays.size()) / bestBare * 1e-6;
    const double tracerRate = static_cast<double>(result.rays) / bestTracer * 1e-6;
    fmt::print(
        "{}: {} photons, {} rays; rtcIntersect1 {:.2f} M rays/s, light tracer {:.2f} M "
        "rays/s, ratio {:.3f}\n",
        name, result.photons, result.rays, bareRate, tracerRate, tracerRate / bareRate);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::uint64_t photons = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1000000;
        measure(argc > 1 ? argv[1] : "pool", photons, argc > 3 ? std::atoi(argv[3]) : 5);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return error.exitCode();
    }
    return 0;
}
