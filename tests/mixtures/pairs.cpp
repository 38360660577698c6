// SPDX-License-Identifier: MIT
#include "tests/mixtures/pairs.h"

#include <algorithm>
#include <map>
#include <set>

namespace kaustik::mixtures {
namespace {

const std::string kSpace = "reconstruct.space";

using Pair = std::pair<Answer, Answer>;

Pair pairOf(const Answer& one, const Answer& other) {
    return one < other ? Pair{one, other} : Pair{other, one};
}

// By stage, those with the most nodes first.
std::vector<std::vector<Answer>> answersByStage() {
    std::vector<std::vector<Answer>> all;
    for (const Registry::StageEntry& stage : registry().stages()) {
        std::vector<Answer> answers;
        for (const std::string& node : nodesOf(stage.name))
            answers.emplace_back(stage.name, node);
        if (answers.size() > 1) all.push_back(std::move(answers));
    }
    all.push_back({{kSpace, "screen"}, {kSpace, "light"}, {kSpace, "cube"}});
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& one, const auto& other) { return one.size() > other.size(); });
    return all;
}

std::set<Pair> pairsApart() {
    std::set<Pair> pairs;
    for (const Apart& apart : answersApart())
        pairs.insert(pairOf(apart.one, apart.other));
    return pairs;
}

// Stages that have something to do only with others' answers or in some scenes.
bool hasWork(const Answer& answer, const std::vector<Answer>& chosen, const std::string& scene) {
    if (answer.first == "refine") {
        return std::find(chosen.begin(), chosen.end(), Answer{"driver", "adaptive"}) !=
               chosen.end();
    }
    if (answer.first == "media" || answer.first == "blur") return scene == "medium";
    return true;
}

// What glossy receivers need, one keeps no account of.
bool isOfScene(const Answer& answer, const std::string& scene) {
    const bool isOfLevels = answer == Answer{ReconstructStage::name, "multi_level"} ||
                            answer == Answer{FilterStage::name, "level_sum"};
    return !isOfLevels || (scene != "glossy" && scene != "mixed");
}

class Covering {
  public:
    Covering() {
        for (const auto& one : stages_) {
            for (const auto& other : stages_) {
                if (&one == &other) continue;
                for (const Answer& a : one) {
                    for (const Answer& b : other)
                        missing_.insert(pairOf(a, b));
                }
            }
        }
        for (const Pair& pair : apart_)
            missing_.erase(pair);
    }

    [[nodiscard]] std::vector<Mixture> mixtures() {
        std::vector<Mixture> all;
        const std::vector<std::string>& scenes = sceneNames();
        std::size_t next = 0;
        // What cannot be covered is left: the tests count what is.
        while (!missing_.empty()) {
            const Pair seed = *missing_.begin();
            std::string scene = scenes[next++ % scenes.size()];
            for (const Answer& answer : {seed.first, seed.second}) {
                if (answer.first == "media" || answer.first == "blur") scene = "medium";
                if (!isOfScene(answer, scene)) scene = scenes.front();
            }
            const std::vector<Answer> chosen = choose(seed, scene);
            cover(chosen, scene);
            missing_.erase(seed);
            Mixture mixture = smallMixture(scene);
            for (const Answer& answer : chosen)
                mixture.set(answer.first, answer.second);
            all.push_back(std::move(mixture));
        }
        return all;
    }

  private:
    [[nodiscard]] bool fits(const Answer& answer, const std::vector<Answer>& chosen,
                            const std::string& scene) const {
        return isOfScene(answer, scene) &&
               std::none_of(chosen.begin(), chosen.end(), [&](const Answer& other) {
                   return apart_.count(pairOf(answer, other)) > 0;
               });
    }

    [[nodiscard]] std::vector<Answer> choose(const Pair& seed, const std::string& scene) const {
        std::vector<Answer> chosen = {seed.first, seed.second};
        const auto isAnswered = [&](const std::string& stage) {
            return std::any_of(chosen.begin(), chosen.end(),
                               [&](const Answer& answer) { return answer.first == stage; });
        };
        const Answer adaptive{"driver", "adaptive"};
        if (isAnswered("refine") && !isAnswered("driver") && fits(adaptive, chosen, scene))
            chosen.push_back(adaptive);
        for (const std::vector<Answer>& stage : stages_) {
            if (isAnswered(stage.front().first)) continue;
            const Answer* best = nullptr;
            int most = -1;
            for (const Answer& answer : stage) {
                if (!fits(answer, chosen, scene)) continue;
                const int gained = static_cast<int>(
                    std::count_if(chosen.begin(), chosen.end(), [&](const Answer& other) {
                        return hasWork(answer, chosen, scene) && hasWork(other, chosen, scene) &&
                               missing_.count(pairOf(answer, other)) > 0;
                    }));
                if (gained <= most) continue;
                most = gained;
                best = &answer;
            }
            if (best != nullptr) chosen.push_back(*best);
        }
        return chosen;
    }

    void cover(const std::vector<Answer>& chosen, const std::string& scene) {
        for (const Answer& one : chosen) {
            for (const Answer& other : chosen) {
                if (hasWork(one, chosen, scene) && hasWork(other, chosen, scene))
                    missing_.erase(pairOf(one, other));
            }
        }
    }

    const std::vector<std::vector<Answer>> stages_ = answersByStage();
    const std::set<Pair> apart_ = pairsApart();
    std::set<Pair> missing_;
};

}  // namespace

std::vector<Apart> answersApart() {
    std::vector<Apart> apart;
    // A map is looked up as it is stored.
    const std::map<std::string, std::string> gathers = {
        {"screen", "screen"}, {"light", "project"}, {"cube", "cube"}};
    for (const auto& [space, own] : gathers) {
        for (const std::string& gather : nodesOf(GatherStage::name)) {
            if (gather != own) apart.push_back({{kSpace, space}, {GatherStage::name, gather}});
        }
    }
    // Several sets of flux need the filter that makes one of them, which needs such sets.
    for (const std::string& reconstruct : nodesOf(ReconstructStage::name)) {
        const std::string wanted = registry().traits<ReconstructStage>(reconstruct).filter;
        for (const std::string& filter : nodesOf(FilterStage::name)) {
            const bool fits =
                wanted.empty() ? filter == "none" || filter == "blur" : filter == wanted;
            if (!fits)
                apart.push_back(
                    {{ReconstructStage::name, reconstruct}, {FilterStage::name, filter}});
        }
    }
    for (const std::string& emit : nodesOf(EmitStage::name)) {
        if (!registry().traits<EmitStage>(emit).emitsCells)
            apart.push_back({{DriverStage::name, "adaptive"}, {EmitStage::name, emit}});
    }
    // Rays of shadow go through the layers that the eye sees. What is inside of bodies some tracers
    // do not see, and of a photon others make several.
    for (const std::string& trace : nodesOf(TraceStage::name)) {
        const auto& traits = registry().traits<TraceStage>(trace);
        if (traits.reach != TracerReach::eyeLayers)
            apart.push_back({{ShadowStage::name, "rays"}, {TraceStage::name, trace}});
        for (const std::string& specular : nodesOf(SpecularStage::name)) {
            if (traits.onlyReceivers && !registry().traits<SpecularStage>(specular).throughBodies)
                apart.push_back({{TraceStage::name, trace}, {SpecularStage::name, specular}});
        }
        if (traits.multipliesLight)
            apart.push_back({{DriverStage::name, "hierarchical"}, {TraceStage::name, trace}});
    }
    // But for a sheet that is a grid of vertices, as no scene here but one has it alone.
    apart.push_back({{DriverStage::name, "hierarchical"}, {EmitStage::name, "vertices"}});
    return apart;
}

const std::vector<Mixture>& mixturesOfAllPairs() {
    static const std::vector<Mixture> mixtures = Covering().mixtures();
    return mixtures;
}

}  // namespace kaustik::mixtures
