// SPDX-License-Identifier: MIT
#include "framework/pipeline/account_sentences.h"

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

const char* accountSentence(unsigned account) {
    using namespace transport;
    switch (account) {
        case kAccountEmitted:
            return "Flux that the lights send onto the specular surfaces that they see first.";
        case kAccountDeposited:
            return "Flux that is stored on receivers: the sum over the map of flux.";
        case kAccountAbsorbed:
            return "Flux that dielectrics, the medium and mirrors have taken.";
        case kAccountLeftScene:
            return "Flux of photons that hit nothing at all.";
        case kAccountUntracedBranch:
            return "Light of the Fresnel branch that is not followed: specular says which one is.";
        case kAccountEmissionSampling:
            return "What the emitter has missed of the lights' flux; below 0 where it caught too "
                   "much.";
        case kAccountOffScreen:
            return "Rays that leave the screen before they hit, and parts of splats beyond its "
                   "border.";
        case kAccountBehindEye:
            return "Rays that go behind the near plane before they hit.";
        case kAccountBeyondLastLayer:
            return "Rays whose hit lies beyond the last layer; more layers.count finds them.";
        case kAccountEdgeOn:
            return "Hits on surfaces that no pixel shows: seen edge-on, or smaller than a pixel.";
        case kAccountMissedByTracer:
            return "Rays whose hit the layers have and the tracer has missed.";
        case kAccountInternalReflectionLimit:
            return "Light totally reflected inside a body that is not followed there.";
        case kAccountBounceLimit:
            return "Light still on its way after as many interactions as are followed.";
        case kAccountNestingLimit:
            return "Light in a dielectric inside of more others than are kept count of.";
        case kAccountOccludedSplat:
            return "Parts of splats that something nearer hides from the eye.";
        case kAccountOutsideMap:
            return "Light that arrives next to the map that it would be stored in.";
        case kAccountHiddenInMap:
            return "Light that arrives behind what the map it would be stored in sees.";
        case kAccountDiscardedTriangle:
            return "Light between photons that cannot be joined and that is thrown away.";
        case kAccountNotANumber:
            return "Photons whose values are no numbers; they are counted and have no watts.";
        case kAccountUnresolved:
            return "Rays that have hit nothing that the layers show, so that what became of them "
                   "is not known.";
        case kAccountAsPublished:
            return "Light that a paper's own approximation loses where none is lost in truth.";
        default:
            return "";
    }
}

}  // namespace kaustik
