# SPDX-License-Identifier: MIT
"""The schema of experiment files (framework/experiment/spec.h)."""
import itertools

from parts import POSITIVE, choice, described, document, flag, number, ref, table, text, whole


# Of [base] and [permute], besides the parameters.
def run_keys(techniques):
    return {
        "scene": text("A name of 'kaustik list scenes', or a file beside the experiment"),
        "technique": choice("A name of 'kaustik list techniques'", techniques),
        "size": text("Of the picture, WIDTHxHEIGHT", pattern="^[0-9]+x[0-9]+$"),
        "frames": whole("Frames that are timed", 1, 1000000),
        "warmup": whole("Frames before them", 0, 1000000),
        "seed": {"description": "Of everything random", "type": "integer"},
        "precise": {"description": "Times each pass with the device finished around it",
                    "type": "boolean"},
        "time": {"description": "Of the animation, s", "type": "number"},
        "time_step": {"description": "From one timed frame to the next, s", "type": "number"},
        "reference": text("none, auto, or a file beside the experiment"),
        "reference_photons": whole("Photons that the reference of auto has at least", 1, 10**15),
        "disable": {"description": "Passes that are not to run", "anyOf": [
            {"type": "string"}, {"type": "array", "items": {"type": "string"}}]},
    }


def parameter(entry):
    unit = f", {entry['unit']}" if entry["unit"] else ""
    sentence = f"{entry['name']}: {entry['description']}{unit}"
    if entry["type"] == "choice":
        return choice(sentence, entry["choices"], entry["default"])
    if entry["type"] == "bool":
        return flag(sentence, entry["default"])
    if entry["type"] == "WxH":
        return text(sentence, pattern="^[0-9]+x[0-9]+$", default=entry["default"])
    kind = "integer" if entry["type"] == "int" else "number"
    return described({"type": kind, "minimum": entry["minimum"], "maximum": entry["maximum"]},
                     sentence, entry["default"])


def short_forms(names):
    """Form → full name, for every form of a parameter's name that means no other."""
    meanings = {}
    for name in names:
        *parts, last = name.split(".")
        for count in range(len(parts) + 1):
            for kept in itertools.combinations(parts, count):
                meanings.setdefault(".".join((*kept, last)), set()).add(name)
    forms = {form: found.pop() for form, found in meanings.items() if len(found) == 1}
    return {**forms, **{name: name for name in names}}


def settings(values):
    """Keys in quotes, "trace.epsilon", and as tables, trace.epsilon."""
    tree = {}
    for name in values:
        node = tree
        for part in name.split("."):
            node = node.setdefault(part, {})

    def properties(node, prefix):
        result = {}
        for part, inner in node.items():
            name = f"{prefix}{part}"
            options = [values[name]] if name in values else []
            if inner:
                options.append({"type": "object", "additionalProperties": False,
                                "properties": properties(inner, name + ".")})
            result[part] = options[0] if len(options) == 1 else {"anyOf": options}
        return result

    quoted = {name: schema for name, schema in values.items() if "." in name}
    return {"type": "object", "additionalProperties": False,
            "properties": {**properties(tree, ""), **quoted}}


def experiment(ask):
    entries = ask("list", "params", "--json")
    keys = run_keys([entry["name"] for entry in ask("list", "techniques", "--json")])
    forms = short_forms([entry["name"] for entry in entries])
    defs = {f"run.{key}": schema for key, schema in keys.items()}
    defs.update((f"parameter.{entry['name']}", parameter(entry)) for entry in entries)
    refs = {key: ref(f"run.{key}") for key in keys}
    for form in sorted(forms):
        refs.setdefault(form, ref(f"parameter.{forms[form]}"))
    defs["range"] = {
        "description": "From one number to another, ends included: times a factor, plus a step, or "
                       "in so many steps",
        **table({"from": {"type": "number"}, "to": {"type": "number"}, "factor": number("", POSITIVE),
                 "step": number(""), "steps": whole("", 2, 10000)}, ("factor", "step", "steps"),
                oneOf=[{"required": [key]} for key in ("factor", "step", "steps")])}
    defs["base"] = settings(refs)
    for key in (*keys, *forms.values()):
        defs[f"axis.{key}"] = {"anyOf": [{"type": "array", "items": refs[key], "minItems": 1},
                                         ref("range")]}
    defs["permute"] = settings({key: ref(f"axis.{forms.get(key, key)}") for key in refs})
    name = text("Names the folder of results", pattern="^[A-Za-z0-9_-]+$")
    sentence = text("For the report", default="")
    study = table({
        "name": name, "description": sentence,
        "repeats": whole("Times that each run is made", 1, 1000, 1),
        "base": described(ref("base"), "What all runs share"),
        "permute": {"description": "Every combination of one value from each key; several tables "
                                   "are a product each",
                    "anyOf": [ref("permute"), {"type": "array", "items": ref("permute"),
                                               "minItems": 1}]}}, ("base", "permute"))
    suite = table({
        "name": name, "description": sentence,
        "suite": choice("The hard cases, in place of runs", ["numerics"]),
        "cases": described({"type": "array", "items": {"type": "string"}},
                           "Only these, such as \"A*\" and \"B13\"", [])})
    defs.update(study=study, suite=suite)
    return document("experiment", "An experiment of Kaustik", {
        "if": {"type": "object", "required": ["suite"]},
        "then": ref("suite"), "else": ref("study")}, defs)
