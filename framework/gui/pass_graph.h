// SPDX-License-Identifier: MIT
// The passes of a frame and what flows between them, laid out for a picture: stages in columns, in
// the order in which they come first. Knows no window.
#pragma once

#include <string>
#include <vector>

#include "framework/graph/graph.h"

namespace kaustik::gui {

struct PassGraph {
    struct Node {
        std::size_t record = 0;  // among the passes
        std::size_t column = 0;  // its stage
        std::size_t row = 0;     // from the top
    };
    // A pass that reads, or writes on in, what another one has written.
    struct Edge {
        std::size_t from = 0;  // nodes
        std::size_t to = 0;
        std::vector<std::string> resources;
    };
    std::vector<Node> nodes;           // what is declared: a skipped pass is not
    std::vector<Edge> edges;           // from an earlier pass to a later one
    std::vector<std::string> columns;  // names of the stages
    std::size_t rows = 0;              // of the longest column
};

[[nodiscard]] PassGraph passGraphOf(const std::vector<graph::PassRecord>& passes);

// Names of what a pass reads, then of what else it writes.
[[nodiscard]] std::vector<std::string> resourcesOf(const graph::PassRecord& pass);

// Passes that write a resource, in their order, without those that are culled; and who reads it.
[[nodiscard]] std::vector<std::string> writersOf(const std::vector<graph::PassRecord>& passes,
                                                 const std::string& resource);
[[nodiscard]] std::vector<std::string> readersOf(const std::vector<graph::PassRecord>& passes,
                                                 const std::string& resource);

// "ran", "bypassed", "culled", "skipped": for the screen map.
[[nodiscard]] const char* nameOf(graph::PassState state);

}  // namespace kaustik::gui
