// SPDX-License-Identifier: MIT
#include "framework/pipeline/trace_record.h"

#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

TraceRecord recordTrace(FrameBuilder& frame, const Hits& hits) {
    struct Data {
        Hits source;
        TraceRecord record;
    };
    const std::string name = fmt::format("audit.trace_{}", frame.runsOf(TraceStage::name));
    return frame
        .pass<Data>(
            "audit.record", "keeps photons and hits for the comparison with exact first hits",
            [&](graph::PassSetup& setup, Data& data) {
                data.source = hits;
                Hits& copies = data.record.hits;
                copies = hits;
                const Photons& photons = hits.incoming;
                const auto copy = [&]<class Content>(graph::Texture<Content>& handle,
                                                     const char* what) {
                    setup.read(handle);
                    handle = setup.create<Content>(name + what, photons.width, photons.height);
                };
                copy(copies.position, ".hit_position");
                copy(copies.surface, ".hit_surface");
                copy(copies.flux, ".hit_flux");
                copy(copies.incoming.position, ".photon_position");
                copy(copies.incoming.direction, ".photon_direction");
                copy(copies.incoming.flux, ".photon_flux");
                setup.read(photons.ledger);
                copies.incoming.ledger = setup.createBuffer<transport::LedgerEntry>(
                    name + ".ledger", transport::kAccountCount);
            },
            [](const Data& data, gl::PassContext& context) {
                const auto copy = [&](const graph::ResourceRef& from,
                                      const graph::ResourceRef& to) {
                    context.texture(from).copyTo(context.texture(to));
                };
                const Hits& from = data.source;
                const Hits& to = data.record.hits;
                copy(from.position, to.position);
                copy(from.surface, to.surface);
                copy(from.flux, to.flux);
                copy(from.incoming.position, to.incoming.position);
                copy(from.incoming.direction, to.incoming.direction);
                copy(from.incoming.flux, to.incoming.flux);
                context.buffer(from.incoming.ledger).copyTo(context.buffer(to.incoming.ledger));
            })
        .record;
}

}  // namespace kaustik
