// SPDX-License-Identifier: MIT
// All parameters of a run, by full name: `stage.node.param`, `stage.param` for what the nodes of a
// stage share, and `stage` itself for the choice of its node. On the way in any shorter form that
// is unique will do; on the way out it is always the full name.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "framework/params/field.h"

namespace kaustik::params {

struct NamedField {
    std::string fullName;
    Field field;
    std::string defaultText;
};

class ParamSet {
  public:
    ParamSet() = default;
    ParamSet(const ParamSet& other);
    ParamSet& operator=(const ParamSet& other);
    ParamSet(ParamSet&&) noexcept = default;
    ParamSet& operator=(ParamSet&&) noexcept = default;
    ~ParamSet() = default;

    // Adds the parameters of `scope` ("trace" or "trace.lines") with their defaults. One that is
    // there already is a ConfigError.
    template <class Params>
    void declare(const std::string& scope, const Params& defaults = {}) {
        add(scope, std::make_unique<Held<Params>>(defaults));
    }

    // Adds `name` ("trace") as a choice among `options`.
    void declareChoice(const std::string& name, std::string sentence,
                       std::vector<std::string> options, const std::string& initial);

    // The values of a declared scope, of the declared type. Throws ConfigError with the nearest
    // scope, or with both types.
    template <class Params>
    [[nodiscard]] const Params& get(const std::string& scope) const {
        return static_cast<const Held<Params>&>(held(scope, typeid(Params))).value;
    }
    [[nodiscard]] std::string choice(const std::string& name) const;
    // The parameter of this full name, pointing into this set. Throws ConfigError where there is
    // none.
    [[nodiscard]] Field find(const std::string& fullName) const;

    // Sets by full name or by a shorter form that is unique: the name's dotted parts must occur in
    // the full name in order, the last one last. Throws ConfigError for an unknown or ambiguous
    // name (with the nearest that exists), one that a parameter had before (with its name today), a
    // bad value or one out of range.
    void set(std::string_view name, std::string_view value, std::string_view where);
    // A technique's own default: range-checked like `set`, but does not count as the user's.
    void setDefault(std::string_view name, std::string_view value, std::string_view where);

    [[nodiscard]] std::string resolve(std::string_view name, std::string_view where) const;
    // The full names of the parameters that were called `name` before, or by a longer form of it
    // where none was called exactly that.
    [[nodiscard]] std::vector<std::string> renamedFrom(std::string_view name) const;
    [[nodiscard]] bool isSetByUser(const std::string& fullName) const;
    [[nodiscard]] const std::set<std::string>& setByUser() const { return setByUser_; }

    // Every parameter, by the names of the scopes, and within one in the order of its declaration.
    // A stage's choice of node comes before what its nodes share.
    [[nodiscard]] std::vector<NamedField> all() const;
    // {"full.name": value, ...}
    [[nodiscard]] nlohmann::json json() const;

  private:
    struct HeldBase {
        virtual ~HeldBase() = default;
        [[nodiscard]] virtual std::unique_ptr<HeldBase> clone() const = 0;
        [[nodiscard]] virtual std::vector<Field> fields() = 0;
        [[nodiscard]] virtual const std::type_info& type() const = 0;
    };
    template <class Params>
    struct Held : HeldBase {
        explicit Held(Params v) : value(std::move(v)) {}
        std::unique_ptr<HeldBase> clone() const override { return std::make_unique<Held>(value); }
        std::vector<Field> fields() override { return fieldsOf(value); }
        const std::type_info& type() const override { return typeid(Params); }
        Params value;
    };
    // A stage's choice of node: names known at run time only.
    struct NodeChoice {
        std::string sentence;
        std::vector<std::string> options;
        int index = 0;
        template <class R>
        void reflect(R& r) {
            r.addChoice(index, "", sentence, options);
        }
    };

    void add(const std::string& scope, std::unique_ptr<HeldBase> held);
    [[nodiscard]] HeldBase& held(const std::string& scope, const std::type_info& type) const;

    std::map<std::string, std::unique_ptr<HeldBase>> scopes_;
    std::map<std::string, std::string> defaults_;     // full name → text
    std::map<std::string, std::string> formerNames_;  // former full name → full name
    std::set<std::string> setByUser_;
};

}  // namespace kaustik::params
