// SPDX-License-Identifier: MIT
#include "framework/gui/variant_parameters.h"

#include "framework/pipeline/effect.h"

namespace kaustik::gui {

std::shared_ptr<const VariantParameters> VariantParametersCache::of(
    const Document& document, std::size_t index, const std::shared_ptr<const FrameResult>& result,
    const Registry& registry) {
    const Variant& variant = index == 1 && document.other ? *document.other : document.variant;
    Key key{variant, document.size, index, result};
    if (newest_ && key == key_) return newest_;
    auto made = std::make_shared<VariantParameters>();
    made->params = settingsOf(variant, document.size, registry).params;
    made->fields = made->params.all();
    const scene::SceneNeeds* needs = result->scene ? &result->scene->needs : nullptr;
    const FrameFacts facts{registry, made->params, needs};
    const std::vector<graph::PassRecord>& passes = result->variants[index].passes;
    for (const params::NamedField& named : made->fields) {
        const std::string& name = named.fullName;
        made->noEffect[name] =
            passes.empty() ? whyNoEffect(facts, name) : whyNoEffect(facts, passes, name);
    }
    key_ = std::move(key);
    newest_ = std::move(made);
    return newest_;
}

}  // namespace kaustik::gui
