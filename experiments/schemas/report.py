# SPDX-License-Identifier: MIT
"""The schema of report.json, kaustik.report/1 (framework/README.md, "The report")."""
from parts import document, ref, table

NUMBER = {"type": "number"}
# A number that is none is null, with a reason.
MEASURE = {"type": ["number", "null"]}
COUNT = {"type": "integer", "minimum": 0}
FLAG = {"type": "boolean"}
TEXT = {"type": "string"}
TEXTS = {"type": "array", "items": TEXT}
REASONS = {"type": "object", "additionalProperties": TEXT,
           "description": "By key, why a number is none"}


def keys(kind, *names):
    return {name: kind for name in names}


def pair(kind):
    return {"type": "array", "items": kind, "minItems": 2, "maxItems": 2}


def counts_by_cause(*causes):
    return table(keys(COUNT, *causes))


def said(text, schema):
    return {"description": text, **schema}


def judged():
    """How wrong an image is, and how wrong the view."""
    optional = ("encircled_energy_radius", "truth_noise", "reasons")
    yield "image_errors", table({
        **keys(MEASURE, "rmse", "rel_mse", "mae", "ssim", "flip_ldr", "flip_hdr", "energy_ratio",
               "encircled_energy_radius_ratio"),
        "counted_pixels": COUNT,
        "formulas": said("By measure: its formula and parameters", {"type": "object"}),
        "encircled_energy_radius": table({
            **keys(NUMBER, "image_px", "reference_px", "image_m", "reference_m"),
            **keys(pair(NUMBER), "image_centre_px", "reference_centre_px")},
            ("image_m", "reference_m")),
        "truth_noise": said("What the reference's own error makes of each measure",
                            table(keys(MEASURE, "rmse", "mae", "rel_mse", "energy_ratio"))),
        "reasons": REASONS}, optional)
    images = {name: {"anyOf": [ref("image_errors"), {"type": "null"}]}
              for name in ("caustic_irradiance", "caustic_radiance", "in_scattered")}
    against = {"reference_estimator": {"enum": ["light", "sppm"]}, "reference_photons": COUNT,
               "reference_key": TEXT, "reference_relative_stderr": MEASURE,
               "reference_stderr": NUMBER, **images, "reasons": REASONS}
    sometimes = (*images, "reference_stderr", "reasons")
    percentiles = keys(MEASURE, "median", "p95", "p99")
    exits = {name: table(percentiles)
             for name in ("exit_direction_deg", "exit_position_m", "exit_position_px")}
    view = table({
        **exits, "pixels": COUNT, "pixels_compared": COUNT, "not_a_number": COUNT,
        **keys(MEASURE, "interfaces_right", "lost", "mean_interfaces"),
        "same_interfaces": table({"pixels": COUNT, **exits}),
        "radiance": {"anyOf": [ref("image_errors"), {"type": "null"}]}, "reasons": REASONS},
        (*exits, "pixels", "pixels_compared", "not_a_number", "interfaces_right", "lost",
         "mean_interfaces", "same_interfaces", "reasons"))
    yield "error", table({
        "reference": TEXT, **against,
        "modelled_paths": said("Against the reference of the paths that the technique follows",
                               table({**against, "maximum_interactions": COUNT,
                                      "transmission_only": FLAG}, sometimes)),
        "flicker": table({**keys(NUMBER, "rms_w_m2", "truth_rms_w_m2", "difference_w_m2",
                                 "truth_stderr_w_m2"),
                          "counted_pixels": COUNT, "of_times_s": pair(NUMBER)}),
        "shadow": table({"pixels": COUNT, **keys(MEASURE, "misclassified", "lit_taken_for_shadow",
                                                 "shadow_taken_for_lit", "in_shadow")}),
        "view": view}, (*sometimes, "modelled_paths", "flicker", "shadow", "view"))


def hits():
    seen = ("off_screen", "behind_eye", "beyond_layers", "edge_on", "tracer", "outside_map",
            "hidden_in_map", "specular")
    return table({
        **keys(COUNT, "photons", "exact_hits", "visible", "right", "right_visible", "nan",
               "unplaced"),
        **keys(MEASURE, "agreement", "agreement_visible", "agreement_reachable", "median_m",
               "p95_m", "p99_m", "max_m", "median_px", "p95_px", "p99_px", "max_px"),
        "false_hits": counts_by_cause(*seen, "displaced", "no_surface", "not_a_number",
                                      "too_near"),
        "missed": counts_by_cause(*seen), "reasons": REASONS}, ("reasons",))


def report():
    defs = dict(judged())
    defs["times"] = said("Milliseconds", table(keys(NUMBER, "median", "mean", "min", "max", "p95",
                                                    "stdev")))
    defs["hits"] = hits()
    defs["pass"] = table({
        **keys(TEXT, "name", "stage", "why"), "ran": FLAG, "repeats": COUNT,
        "gpu_ms": ref("times"), "cpu_ms": ref("times")}, ("repeats", "gpu_ms", "cpu_ms"))
    needs = table({
        **keys(COUNT, "specular_interfaces", "reflectors", "refractors", "lights",
               "depth_complexity"),
        **keys(FLAG, "closed_dielectrics", "medium", "glossy_receivers", "animated", "receivers")})
    top = {
        "$schema": TEXT, "schema": {"const": "kaustik.report/1"}, "version": TEXT,
        "device": table({**keys(TEXT, "renderer", "vendor", "gl", "cpu", "platform", "uuid"), "gl_debug": FLAG,
                         "threads": COUNT}),
        "scene": table({"name": TEXT, "triangles": COUNT, "needs": needs}),
        "technique": TEXT,
        "parameters": said("By full name", {"type": "object"}),
        "disabled": TEXTS, "time_s": NUMBER, "time_step_s": NUMBER, "seed": {"type": "integer"},
        "size": pair(COUNT), "frames": COUNT, "warmup": COUNT,
        "timer": {"enum": ["gpu", "finish"]},
        "frame_ms": ref("times"), "bookkeeping_ms": ref("times"), "graph_build_ms": NUMBER,
        "startup_ms": NUMBER,
        "passes": {"type": "array", "items": ref("pass")},
        "photons": table(keys(COUNT, "emitted", "specular", "hit", "missed", "nan")),
        "layers": table(keys(COUNT, "allowed", "complexity", "peeled", "fragments",
                             "fragments_left_out", "pixels_left_out")),
        "energy": said("The ledger, W", table({
            **keys(NUMBER, "emitted_w", "deposited_w", "absorbed_w", "left_scene_w", "balance"),
            "lost_w": said("By cause", {"type": "object", "additionalProperties": NUMBER})})),
        "memory": table(keys(COUNT, "texture_bytes", "buffer_bytes", "scene_bytes", "peak_bytes")),
        "limits": {"type": "array", "items": table({
            **keys(TEXT, "limit", "unit", "lost"), "value": NUMBER, "needed": MEASURE,
            "lost_w": MEASURE}, ("lost_w",))},
        "warnings": TEXTS,
        "map": said("Where light is stored off the screen", table({
            "space": {"enum": ["light", "cube"]},
            "maps": {"type": "array", "items": table({
                **keys(COUNT, "light", "generator", "views"), "size": pair(COUNT)},
                ("light", "generator"))},
            **keys(MEASURE, "flux_ratio", "blend_energy_ratio", "seen_ratio"),
            "reasons": REASONS}, ("reasons",))),
        "cells": said("Of photons that were chosen cell by cell", table(keys(
            COUNT, "probes", "photons", "merged", "discarded", "deepest_level", "rounds",
            "batches"))),
        "hits": said("Where photons land, against the exact first hits", ref("hits")),
        "error": said("How wrong the outputs are, against the reference", ref("error")),
    }
    return document("report", "A report of 'kaustik run'",
                    table(top, ("$schema", "map", "cells", "hits", "error")), defs)
