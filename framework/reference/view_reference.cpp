// SPDX-License-Identifier: MIT
#include "framework/reference/view_reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

#include "framework/reference/eye.h"
#include "framework/reference/eye_path.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/receivers.h"
#include "framework/reference/threads.h"

namespace kaustik::reference {
namespace {

struct ExitSink : NullSink {
    void hitSurface(const SurfaceHit& hit, const PhotonState&) {
        position = hit.position;
        ++count;
    }
    void leftScene(const PhotonState& state) { end(state); }
    void arrived(const SurfaceHit&, const PhotonState& state) { end(state); }
    void end(const PhotonState& state) {
        direction = state.direction;
        cameOut = true;
    }
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0};
    int count = 0;
    bool cameOut = false;
};

struct RadianceSink : NullSink {
    RadianceSink(const EmbreeScene& from, const Receivers& lit, double index)
        : scene(from), receivers(lit), indexAtEye(index) {}
    void arrived(const SurfaceHit& hit, const PhotonState& state) {
        sum += weight(state) * receivers.radiance(hit, state.direction);
    }
    void leftScene(const PhotonState& state) {
        glm::dvec3 left = weight(state);
        const std::uint32_t inner = state.media.inner();
        // A medium without end leaves nothing of what it absorbs.
        for (int c = 0; inner != 0 && c < 3; ++c) {
            if (scene.scene().materials[inner - 1].absorptionPerMeter[c] > 0.0f) left[c] = 0.0;
        }
        sum += left * scene.appearance().environment(state.direction);
    }
    // Flux is what a branch keeps; radiance changes by the square of the index too.
    [[nodiscard]] glm::dvec3 weight(const PhotonState& state) const {
        const double ratio = indexAtEye / mediumIndex(scene.scene(), state.media.inner());
        return state.fluxWatts * ratio * ratio;
    }
    const EmbreeScene& scene;
    const Receivers& receivers;
    double indexAtEye = 1.0;
    glm::dvec3 sum{0.0};
};

class Tracer {
  public:
    Tracer(const EmbreeScene& scene, const ViewReferenceRequest& request, ViewReference& reference)
        : scene_(scene),
          eye_(scene, request.width, request.height),
          receivers_(scene),
          request_(request),
          reference_(reference),
          toView_(glm::transpose(glm::dmat3(right(), up(), backward()))) {}

    void traceRow(int row) const {
        for (int column = 0; column < request_.width; ++column) {
            if (traceExit(column, row)) traceRadiance(column, row);
        }
    }

  private:
    // The eye's axes, from its rays: the middle of the picture and one pixel next to it.
    [[nodiscard]] glm::dvec3 backward() const {
        return -eye_.ray(0.5 * request_.width, 0.5 * request_.height);
    }
    [[nodiscard]] glm::dvec3 right() const {
        return glm::normalize(eye_.ray(1.0, 0.0) - eye_.ray(0.0, 0.0));
    }
    [[nodiscard]] glm::dvec3 up() const {
        return glm::normalize(eye_.ray(0.0, 0.0) - eye_.ray(0.0, 1.0));
    }

    // The state at the near plane of the ray through a point of the picture.
    [[nodiscard]] std::optional<PhotonState> start(double column, double row) const {
        const glm::dvec3 ray = eye_.ray(column, row);
        return startAtEye(scene_, eye_.position() + eye_.nearMeters() * ray, glm::normalize(ray));
    }

    // False where the pixel's middle sees no specular surface.
    bool traceExit(int column, int row) const {
        const std::optional<PhotonState> state = start(column + 0.5, row + 0.5);
        if (!state) return false;
        PathFilter transmitted;
        transmitted.transmissionOnly = true;
        transmitted.maximumInteractions = request_.maximumInteractions;
        ExitSink sink;
        Random random(request_.seed, 0, 0);  // nothing is chosen
        LightTransport(scene_, transmitted).finish(*state, nullptr, random, sink);
        if (sink.count == 0) return false;
        const glm::dvec3 position = toView_ * (sink.position - eye_.position());
        const glm::dvec3 direction = toView_ * sink.direction;
        for (int c = 0; c < 3; ++c) {
            reference_.exitPosition.at(column, row, c) = static_cast<float>(position[c]);
            reference_.exitDirection.at(column, row, c) = static_cast<float>(direction[c]);
        }
        reference_.exitPosition.at(column, row, 3) = static_cast<float>(sink.count);
        reference_.exitDirection.at(column, row, 3) = sink.cameOut ? 1.0f : 0.0f;
        reference_.mask.at(column, row, 0) = 1.0f;
        return true;
    }

    [[nodiscard]] glm::dvec3 sample(double column, double row, Random& random) const {
        const std::optional<PhotonState> state = start(column, row);
        if (!state) {
            return scene_.appearance().environment(glm::normalize(eye_.ray(column, row)));
        }
        PathFilter all;
        all.splitInteractions = request_.splitInteractions;
        all.maximumInteractions = request_.maximumInteractions;
        RadianceSink sink(scene_, receivers_, mediumIndex(scene_.scene(), state->media.inner()));
        LightTransport(scene_, all).finish(*state, nullptr, random, sink);
        return sink.sum;
    }

    void traceRadiance(int column, int row) const {
        const int side = request_.samplesPerSide;
        const double count = static_cast<double>(side) * side;
        glm::dvec3 sum(0.0);
        glm::dvec3 squares(0.0);
        Random random(request_.seed, 1,
                      static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(request_.width) +
                          static_cast<std::uint64_t>(column));
        for (int i = 0; i < side * side; ++i) {
            const double x = column + (i % side + random.uniform()) / side;
            const double y = row + (i / side + random.uniform()) / side;
            const glm::dvec3 value = sample(x, y, random);
            sum += value;
            squares += value * value;
        }
        const glm::dvec3 mean = sum / count;
        for (int c = 0; c < 3; ++c) {
            // As if the samples were independent; jittered, they are a little better.
            const double variance = std::max(squares[c] / count - mean[c] * mean[c], 0.0);
            reference_.radiance.at(column, row, c) = static_cast<float>(mean[c]);
            reference_.radianceError.at(column, row, c) =
                static_cast<float>(std::sqrt(variance / std::max(count - 1.0, 1.0)));
        }
    }

    const EmbreeScene& scene_;
    Eye eye_;
    Receivers receivers_;
    ViewReferenceRequest request_;
    ViewReference& reference_;
    glm::dmat3 toView_;
};

}  // namespace

void ViewReference::countPixels() {
    pixels = static_cast<std::size_t>(std::count(mask.values.begin(), mask.values.end(), 1.0f));
}

ViewReference emptyView(const ViewReferenceRequest& request) {
    const auto image = [&](int channels) { return Image(request.width, request.height, channels); };
    return {image(4), image(4), image(3), image(3), image(1), 0};
}

ViewReference traceView(const EmbreeScene& scene, const ViewReferenceRequest& request) {
    ViewReference reference = emptyView(request);
    const Tracer tracer(scene, request, reference);
    runWithThreads(request.threads, [&] {
        tbb::parallel_for(0, request.height, [&](int row) { tracer.traceRow(row); });
    });
    reference.countPixels();
    return reference;
}

}  // namespace kaustik::reference
