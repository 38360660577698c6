// SPDX-License-Identifier: MIT
// What long work tells a Python function on its way.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <optional>
#include <string>
#include <utility>

namespace kaustik::python {

// Tells a Python function, which may raise and by that end the work.
class Progress {
  public:
    explicit Progress(pybind11::object function) : function_(std::move(function)) {}

    void tell(double share, const std::string& reached) {
        if (function_.is_none() || hasFailed_) return;
        const pybind11::gil_scoped_acquire gil;
        try {
            function_(share, reached);
        } catch (pybind11::error_already_set& error) {
            raised_.emplace(error);
            hasFailed_ = true;
        }
    }
    [[nodiscard]] bool hasFailed() const { return hasFailed_; }
    void throwIfFailed() {
        if (raised_) throw pybind11::error_already_set(*raised_);
    }

  private:
    pybind11::object function_;
    std::optional<pybind11::error_already_set> raised_;
    std::atomic<bool> hasFailed_{false};
};

}  // namespace kaustik::python
