# SPDX-License-Identifier: MIT
"""What schemas are made of."""

DRAFT = "https://json-schema.org/draft/2020-12/schema"
# As framework/scene/files/table_reader.h has them.
LARGEST = 1e9
ANY = {"minimum": -LARGEST, "maximum": LARGEST}
POSITIVE = {"minimum": 1e-9, "maximum": LARGEST}
NOT_NEGATIVE = {"minimum": 0, "maximum": LARGEST}
UNIT = {"minimum": 0, "maximum": 1}


def described(schema, text, default=None):
    result = {"description": text, **schema}
    if default is not None:
        result["default"] = default
    return result


def number(text, limits=ANY, default=None):
    return described({"type": "number", **limits}, text, default)


def whole(text, least, most, default=None):
    return described({"type": "integer", "minimum": least, "maximum": most}, text, default)


def vector(text, limits=ANY, default=None, size=3, of="number"):
    return described({"type": "array", "items": {"type": of, **limits}, "minItems": size,
                      "maxItems": size}, text, default)


def one_or_vector(text, limits=ANY, default=None, size=3, of="number"):
    several = vector("", limits, None, size, of)
    del several["description"]
    return described({"anyOf": [{"type": of, **limits}, several]}, text, default)


def direction(text):
    return {**vector(text), "contains": {"not": {"const": 0}}}


def text(sentence, **more):
    return {"description": sentence, "type": "string", **more}


def flag(sentence, default=False):
    return described({"type": "boolean"}, sentence, default)


def choice(sentence, values, default=None):
    return described({"enum": values}, sentence, default)


def table(properties, optional=(), title=None, **rules):
    """Keys are required unless they have a default or are in `optional`."""
    required = [key for key, schema in properties.items()
                if "default" not in schema and key not in optional]
    result = {"type": "object", "properties": properties, "additionalProperties": False, **rules}
    if required:
        result["required"] = required
    if title:
        result["title"] = title
    return result


def ref(name):
    return {"$ref": f"#/$defs/{name}"}


def several(name, sentence):
    return described({"type": "array", "items": ref(name)}, sentence)


def document(name, title, schema, defs):
    return {"$schema": DRAFT, "$id": f"{name}.schema.json", "title": title, **schema, "$defs": defs}
