// SPDX-License-Identifier: MIT
#include "framework/pipeline/limit.h"

#include "framework/gl/executor.h"

namespace kaustik {

std::size_t countHits(const gl::Executor& executor, const Hits& hits, std::uint32_t fate,
                      double fromShare) {
    const std::size_t listed =
        executor.buffer(hits.incoming.list).read<transport::PhotonList>().front().count;
    const std::vector<float> texels = executor.texture(hits.flux).read();
    std::size_t count = 0;
    const auto first = static_cast<std::size_t>(fromShare * static_cast<double>(listed) + 0.5);
    for (std::size_t i = first; i < listed; ++i)
        count += static_cast<std::uint32_t>(texels[4 * i + 3]) == fate ? 1 : 0;
    return count;
}

}  // namespace kaustik
