// SPDX-License-Identifier: MIT
#include "framework/numerics/probe.h"

#include "framework/gl/executor.h"

namespace kaustik::numerics {

std::vector<glm::vec4> probe(gl::Context& context, const std::string& shader,
                             const std::vector<glm::vec4>& inputs, int caseCount,
                             int outputsPerCase, const std::function<void(gl::Command&)>& bind) {
    struct Data {
        graph::Buffer<glm::vec4> outputs;
    };
    graph::Graph graph;
    const gl::Buffer inputBuffer(inputs, "inputs");
    const Data& data = graph.addPass<Data, gl::PassContext>(
        {"probe", ""},
        [&](graph::PassSetup& setup, Data& d) {
            d.outputs = setup.createBuffer<glm::vec4>(
                "outputs", static_cast<std::size_t>(caseCount * outputsPerCase));
        },
        [&](const Data& d, gl::PassContext& pass) {
            gl::Command command = pass.compute(shader);
            bind(command);
            command.storage("Inputs", inputBuffer)
                .storage("Outputs", d.outputs)
                .set("caseCount", caseCount)
                .dispatchOver(caseCount, 64);
        });
    graph.request(data.outputs);
    gl::ProgramCache programs;
    gl::Executor executor(context, programs);
    executor.prepare(graph.compile());
    gl::PassTimer timer(gl::TimerMode::finish);
    executor.runFrame(timer);
    return executor.buffer(data.outputs).read<glm::vec4>();
}

}  // namespace kaustik::numerics
