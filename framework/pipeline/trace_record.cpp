// SPDX-License-Identifier: MIT
#include "framework/pipeline/trace_record.h"

#include "framework/pipeline/frame_builder.h"
#include "framework/transport/primitives.h"

namespace kaustik {

Ledger copyLedger(FrameBuilder& frame, const Ledger& ledger, const std::string& name) {
    struct Data {
        Ledger from;
        Ledger to;
    };
    return frame
        .pass<Data>(
            "audit.record", "what a tracer itself says of the photons that it loses",
            [&](graph::PassSetup& setup, Data& data) {
                data.from = setup.read(ledger);
                data.to =
                    setup.createBuffer<transport::LedgerEntry>(name, transport::kLedgerEntryCount);
            },
            [](const Data& data, gl::PassContext& context) {
                context.buffer(data.from).copyTo(context.buffer(data.to));
            })
        .to;
}

}  // namespace kaustik
