# SPDX-License-Identifier: MIT
"""The schema of scene files (experiments/scenes/README.md)."""
from parts import (ANY, NOT_NEGATIVE, POSITIVE, UNIT, choice, described, direction, document, flag,
                   number, one_or_vector, ref, several, table, text, vector, whole)

MOST_CELLS = 2048  # kMaximumCells of framework/scene/shapes/shapes.h
NAME = text("Unique among those of its kind", minLength=1)


def lights():
    color = one_or_vector("Multiplies the power, by channel", NOT_NEGATIVE, 1)
    one_power = {"oneOf": [{"required": ["intensity"]}, {"required": ["power_watts"]}]}

    def light(kind, keys, optional=(), **rules):
        return table({"name": NAME, "type": {"const": kind}, "color": color, **keys}, optional,
                     f"{kind} light", **rules)

    towards = direction("Where its light goes")
    lamp = {"position": vector("Where it is, m"),
            "intensity": number("W/sr on the axis", NOT_NEGATIVE),
            "power_watts": number("Flux of the whole light, in place of its intensity",
                                  NOT_NEGATIVE),
            "range": number("How far it shines, m; 0 is unlimited", NOT_NEGATIVE, 0)}
    powers = ("intensity", "power_watts")
    return {
        "light_directional": light("directional", {
            "direction": towards,
            "irradiance": number("W/m² on a surface that faces the light", NOT_NEGATIVE)}),
        "light_point": light("point", lamp, powers, **one_power),
        "light_spot": light("spot", {
            "direction": towards, **lamp,
            "inner_cone_degrees": number("Half-angle of full light", {"minimum": 0, "maximum": 90},
                                         0),
            "outer_cone_degrees": number("Half-angle where light ends; at most 89 with a texture",
                                         {"exclusiveMinimum": 0, "maximum": 90}, 45),
            "texture": text("An image beside the scene file, which multiplies the intensity"),
            "up": direction("Where the top of the texture points")},
            (*powers, "texture", "up"), dependentRequired={"up": ["texture"]}, **one_power),
    }


def materials():
    def material(kind, keys, optional=()):
        return table({"name": NAME, "type": {"const": kind}, **keys}, optional, f"{kind} material")

    diffuse = {
        "albedo": one_or_vector("Share of light that is reflected in all directions", UNIT),
        "pattern": choice("What is mixed with a second albedo", ["none", "checker", "tiles"],
                          "none"),
        "pattern_albedo": one_or_vector("The second albedo", UNIT, 0.25),
        "uv_scale": one_or_vector("Repeats of pattern and texture a unit of uv", POSITIVE, 1, 2),
        "texture": text("An image beside the scene file, which multiplies the albedo")}
    absorption = one_or_vector("Absorption inside, 1/m", NOT_NEGATIVE, 0)
    return {
        "material_lambertian": material("lambertian", diffuse, ("texture",)),
        "material_glossy": material("glossy", {
            **diffuse,
            "specular": one_or_vector("Share of light in the lobe; with an albedo at most 1", UNIT),
            "exponent": number("Of the lobe's cosine", {"minimum": 1, "maximum": 10000}, 50)},
            ("texture",)),
        "material_dielectric": material("dielectric", {
            "ior": number("Index of refraction", {"minimum": 1, "maximum": 10}),
            "absorption_per_meter": absorption}),
        "material_mirror": material("mirror", {
            "reflectance": one_or_vector("Share of light that is reflected", UNIT, 1)}),
    }


def objects():
    def segments(sentence, least, default):
        return whole(sentence, least, MOST_CELLS, default)

    around = "Straight pieces around the axis"
    radius = number("m", POSITIVE)
    height = number("m", POSITIVE)
    placed = {
        "name": NAME,
        "material": text("The name of a [[material]]"),
        "position": vector("Where its origin is, m", ANY, [0, 0, 0]),
        "rotation_degrees": vector("About the fixed axes x, then y, then z", ANY, [0, 0, 0]),
        "scale": one_or_vector("Of its size, along its own axes", POSITIVE, 1)}
    inward = flag("Whether its faces look inwards")
    shapes = {
        "plane": {"size": vector("Along x and z, m", POSITIVE, None, 2),
                  "cells": one_or_vector("Squares along x and z",
                                         {"minimum": 1, "maximum": MOST_CELLS}, 1, 2, "integer")},
        "box": {"size": vector("Along x, y and z, m", POSITIVE), "inward": inward,
                "open": described({"type": "array", "items": {
                    "enum": ["-x", "+x", "-y", "+y", "-z", "+z"]}}, "Sides that are left out", [])},
        "sphere": {"radius": radius, "segments": segments(around, 4, 128)},
        "cylinder": {"radius": radius, "height": height, "open": flag("Without its ends"),
                     "inward": inward, "segments": segments(around, 3, 128)},
        "ring": {"inner_radius": radius, "outer_radius": radius, "height": height,
                 "segments": segments(around, 3, 256)},
        "torus": {"radius": number("Of the tube's middle, m", POSITIVE),
                  "tube_radius": radius, "segments": segments(around, 3, 128),
                  "tube_segments": segments("Straight pieces around the tube", 3, 64)},
        "tree": {"height": height, "trunk_radius": radius,
                 "levels": segments("How often branches branch", 1, 5),
                 "children": segments("Branches of a branch", 1, 3),
                 "sides": segments("Of a branch", 3, 6),
                 "spread_degrees": number("How far branches lean", POSITIVE, 38),
                 "seed": segments("Of everything random about it", 1, 1)},
        "lens": {"top_radius": number("Of the upper face, m; negative is concave, 0 flat"),
                 "bottom_radius": number("Of the lower face, m; negative is concave, 0 flat"),
                 "diameter": number("m", POSITIVE),
                 "center_thickness": number("m; or edge_thickness", POSITIVE, 0),
                 "edge_thickness": number("m; or center_thickness", POSITIVE, 0),
                 "segments": segments(around, 3, 128)},
        "prism": {"apex_degrees": number("Of the upper edge",
                                         {"exclusiveMinimum": 0, "exclusiveMaximum": 180}),
                  "height": height, "length": number("Along the upper edge, m", POSITIVE)},
        "paraboloid": {"focal_length": number("m", POSITIVE), "diameter": number("m", POSITIVE),
                       "segments": segments(around, 3, 128)},
        "water": {"size": vector("Along x and z, m", POSITIVE, None, 2),
                  "cells": one_or_vector("Squares along x and z",
                                         {"minimum": 1, "maximum": MOST_CELLS}, 128, 2, "integer"),
                  "waves": several("wave", "Waves that add up"),
                  "wave": several("wave", "The same as [[object.wave]]")},
    }
    result = {f"object_{shape}": table({**placed, "shape": {"const": shape}, **keys},
                                       ("waves", "wave"), shape)
              for shape, keys in shapes.items()}
    result["object_water"]["not"] = {"required": ["wave", "waves"]}
    result["object_mesh"] = table({
        **placed,
        "mesh": text("A file .obj, .ply, .ply.gz or .3ds, beside the scene file or in meshes/"),
        "fit": {"description": "Scales it to a height or to its longest side, m",
                **table({"height": height, "size": height}, ("height", "size"), minProperties=1,
                        maxProperties=1)},
        "rest_on": number("The height that its lowest point stands at, m")},
        ("fit", "rest_on"), "mesh", **{"not": {"required": ["fit", "scale"]}})
    return result


def any_of(defs, prefix):
    return {"oneOf": [ref(name) for name in defs if name.startswith(prefix)]}


def scene():
    defs = {**lights(), **materials(), **objects()}
    defs["light"] = any_of(defs, "light_")
    defs["material"] = any_of(defs, "material_")
    defs["object"] = any_of(defs, "object_")
    defs["wave"] = table({
        "amplitude": number("m", NOT_NEGATIVE), "wavelength": number("m", POSITIVE),
        "direction_degrees": number("Of its travel, from +x towards +z", ANY, 0),
        "phase": number("Radians", ANY, 0),
        "omega": number("Radians a second; that of gravity waves if not given", NOT_NEGATIVE)},
        ("omega",))
    defs["camera"] = table({
        "position": vector("m"), "target": vector("What it looks at, m", ANY, [0, 0, 0]),
        "up": direction("Where the top of the picture points; [0, 1, 0] if not given"),
        "vertical_fov_degrees": number("Field of view",
                                       {"exclusiveMinimum": 0, "exclusiveMaximum": 180}, 45),
        "near": number("Distance of the near plane, m", POSITIVE, 0.01)}, ("up",))
    defs["medium"] = table({
        "scattering_per_meter": one_or_vector("1/m", NOT_NEGATIVE, 0),
        "absorption_per_meter": one_or_vector("1/m", NOT_NEGATIVE, 0),
        "anisotropy": number("Henyey-Greenstein g",
                             {"exclusiveMinimum": -1, "exclusiveMaximum": 1}, 0)})
    defs["environment"] = table({
        "image": text("A latitude-longitude picture beside the scene file"),
        "pattern": choice("A picture that needs no file", ["sky", "grid"]),
        "turn_degrees": number("About +y, counter-clockwise from above", ANY, 0)},
        ("image", "pattern"),
        oneOf=[{"required": ["image"]}, {"required": ["pattern"]}])
    defs["light_edit"] = table({
        "name": text("The light that is changed", minLength=1),
        "direction": direction("Where its light goes"), "position": vector("m"),
        "power_factor": number("Multiplies its power", NOT_NEGATIVE)},
        ("direction", "position", "power_factor"))
    defs["water_edit"] = table({
        "object": text("The water that is changed"),
        "waves": several("wave", "Its waves"), "wave": several("wave", "The same as [[water.wave]]")
    }, ("waves", "wave"), **{"not": {"required": ["wave", "waves"]}})

    common = {"name": text("That of the file if not given"),
              "description": text("A sentence for lists", default=""),
              "time": number("Of the animation, s", ANY, 0),
              "camera": ref("camera"), "medium": ref("medium")}
    optional = ("name", "camera", "medium", "environment", "light", "material", "object", "water")
    defs["scene"] = table({
        **common,
        "background_radiance": one_or_vector("W/m²/sr", NOT_NEGATIVE, 0),
        "ambient_irradiance": one_or_vector("W/m², for the picture only", NOT_NEGATIVE, 0),
        "environment": ref("environment"), "light": several("light", "What shines"),
        "material": several("material", "What objects are made of"),
        "object": several("object", "Meshes and shapes")}, optional)
    defs["extension"] = table({
        "extends": text("Another scene: a name, or a path seen from this file"), **common,
        "light": several("light_edit", "Changes to lights"),
        "water": several("water_edit", "Changes to waters")}, optional)
    return document("scene", "A scene of Kaustik", {
        "if": {"type": "object", "required": ["extends"]},
        "then": ref("extension"), "else": ref("scene")}, defs)
