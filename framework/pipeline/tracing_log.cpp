// SPDX-License-Identifier: MIT
#include "framework/pipeline/tracing_log.h"

#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/photon_texels.h"
#include "framework/transport/primitives.h"

namespace kaustik {
namespace {

// Adds what is in flight, and of which no other batch is the owner.
void addPhotons(TracingLog& log, const std::vector<PhotonTexel>& photons,
                const std::vector<HitTexel>& hits, const CellGrid& cells) {
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const PhotonTexel& photon = photons[i];
        if (photon.fate == kNoWord) ++log.notANumber;
        if (photon.fate != transport::kFateInFlight || !cells.isOwn(photon.origin.cell)) continue;
        if (!isFinite(photon.position) || !isFinite(photon.direction) ||
            !isFinite(photon.fluxWatts) || photon.media == kNoWord) {
            ++log.notANumber;
            continue;
        }
        log.photons.push_back({photon.position, photon.direction, photon.fluxWatts, photon.media,
                               photon.origin.light, hits[i].isHit() || hits[i].fate == kNoWord,
                               hits[i].position});
    }
}

}  // namespace

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void addBooked(EnergyLedger& sum, const EnergyLedger& before, const EnergyLedger& after) {
    for (std::size_t account = 0; account < sum.watts.size(); ++account) {
        sum.watts[account] += after.watts[account] - before.watts[account];
        sum.events[account] += after.events[account] - before.events[account];
    }
}

std::shared_ptr<const TracingLog> readTracing(const Renderer& renderer, const TraceRecord& trace) {
    if (trace.log) return trace.log;
    auto log = std::make_shared<TracingLog>();
    const Photons& photons = trace.hits.incoming;
    addPhotons(*log, readPhotons(renderer, photons), readHits(renderer, trace.hits), photons.cells);
    addBooked(log->booked, renderer.ledger(trace.before), renderer.ledger(trace.after));
    return log;
}

void logTracing(FrameBuilder& frame, TraceRecord& record, const std::string& name) {
    struct Data {
        Hits hits;
        Ledger before;
        Ledger at;
        Ledger after;
    };
    const auto log = std::make_shared<TracingLog>();
    record.log = log;
    const float quantumWatts = frame.inputs().ledgerQuantumWatts;
    record.after =
        frame
            .pass<Data>(
                "audit.record", "what each run of a loop has traced",
                [&](graph::PassSetup& setup, Data& data) {
                    data.hits = record.hits;
                    for (const graph::ResourceRef& handle : texelsOf(record.hits))
                        static_cast<void>(setup.read(handle));
                    data.before = setup.read(record.before);
                    data.at = setup.read(record.hits.incoming.ledger);
                    data.after = setup.createBuffer<transport::LedgerEntry>(
                        name, transport::kLedgerEntryCount);
                },
                [log, quantumWatts](const Data& data, gl::PassContext& context) {
                    if (!context.isRepeated()) *log = {};
                    log->beforeLast = log->photons.size();
                    addPhotons(*log, readPhotons(context, data.hits.incoming),
                               readHits(context, data.hits), data.hits.incoming.cells);
                    addBooked(log->booked, readLedger(context.buffer(data.before), quantumWatts),
                              readLedger(context.buffer(data.at), quantumWatts));
                    context.buffer(data.at).copyTo(context.buffer(data.after));
                })
            .after;
}

}  // namespace kaustik
