// SPDX-License-Identifier: MIT
#include "framework/scene/meshes/orientation.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "framework/scene/meshes/position_welding.h"
#include "framework/scene/triangles.h"

namespace kaustik::scene {
namespace {

constexpr std::uint32_t kNone = ~0u;

// The two triangles along an edge, and whether both run along it in the same direction.
struct Edge {
    std::uint32_t one = kNone;
    std::uint32_t other = kNone;
    bool isOneForward = false;
    bool isSame = false;
    bool isShared = false;  // by more than two
};

std::vector<Edge> edgesOf(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weldPositions(mesh.positions);
    std::unordered_map<std::uint64_t, Edge> edges;
    edges.reserve(mesh.triangles.size() * 3 / 2);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = welded[mesh.triangles[t][corner]];
            const std::uint32_t to = welded[mesh.triangles[t][(corner + 1) % 3]];
            if (from == to) continue;
            const std::uint64_t key =
                static_cast<std::uint64_t>(std::min(from, to)) << 32 | std::max(from, to);
            Edge& edge = edges[key];
            if (edge.one == kNone) {
                edge.one = t;
                edge.isOneForward = from < to;
            } else if (edge.other == kNone) {
                edge.other = t;
                edge.isSame = edge.isOneForward == (from < to);
            } else {
                edge.isShared = true;
            }
        }
    }
    std::vector<Edge> joining;
    for (const auto& [key, edge] : edges) {
        if (edge.other != kNone && edge.other != edge.one && !edge.isShared)
            joining.push_back(edge);
    }
    return joining;
}

struct Neighbour {
    std::uint32_t triangle;
    bool isAgainst;  // faces the other way
};

std::vector<std::vector<Neighbour>> neighboursOf(const Mesh& mesh, const std::vector<Edge>& edges) {
    std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
    for (const Edge& edge : edges) {
        neighbours[edge.one].push_back({edge.other, edge.isSame});
        neighbours[edge.other].push_back({edge.one, edge.isSame});
    }
    return neighbours;
}

}  // namespace

Orientation orientTriangles(Mesh& mesh) {
    const std::vector<Edge> edges = edgesOf(mesh);
    Orientation done;
    // As nearly every mesh is.
    if (std::none_of(edges.begin(), edges.end(), [](const Edge& edge) { return edge.isSame; }))
        return done;
    const std::vector<std::vector<Neighbour>> neighbours = neighboursOf(mesh, edges);
    enum Side : std::uint8_t { unknown, asTheFirst, against };
    std::vector<Side> sides(mesh.triangles.size(), unknown);
    std::vector<std::uint32_t> surface;
    for (std::uint32_t first = 0; first < mesh.triangles.size(); ++first) {
        if (sides[first] != unknown) continue;
        surface.assign(1, first);
        sides[first] = asTheFirst;
        bool isOrientable = true;
        double areas[3] = {};
        for (std::size_t next = 0; next < surface.size(); ++next) {
            const std::uint32_t triangle = surface[next];
            const Side side = sides[triangle];
            areas[side] +=
                glm::length(areaOf(cornersOf(mesh, mesh.triangles[triangle], glm::dmat4(1.0))));
            for (const auto& [other, isAgainst] : neighbours[triangle]) {
                const Side wanted = isAgainst == (side == asTheFirst) ? against : asTheFirst;
                if (sides[other] == unknown) {
                    sides[other] = wanted;
                    surface.push_back(other);
                }
                isOrientable = isOrientable && sides[other] == wanted;
            }
        }
        if (!isOrientable) {
            done.unorientable += surface.size();
            continue;
        }
        const Side turned = areas[against] > areas[asTheFirst] ? asTheFirst : against;
        for (const std::uint32_t triangle : surface) {
            if (sides[triangle] != turned) continue;
            std::swap(mesh.triangles[triangle].y, mesh.triangles[triangle].z);
            ++done.turned;
        }
    }
    return done;
}

}  // namespace kaustik::scene
