"""Derives bdpt's expected verdict on a file from the Khronos validator's report."""

import copy
import json
import pathlib

# These errors make a file unsafe or ambiguous: it must be refused. Codes are those of the Khronos validator (its
# ISSUES.md).
REFUSE = {
    "ACCESSOR_INDEX_OOB", "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "ACCESSOR_SPARSE_INDEX_OOB",
    "ACCESSOR_SPARSE_INDICES_NON_INCREASING", "ACCESSOR_TOO_LONG", "BUFFER_BYTE_LENGTH_MISMATCH",
    "BUFFER_VIEW_TOO_LONG", "DUPLICATE_ELEMENTS_KEY", "GLB_CHUNK_TOO_BIG", "GLB_DUPLICATE_CHUNK", "GLB_INVALID_MAGIC",
    "GLB_INVALID_VERSION", "GLB_LENGTH_MISMATCH", "GLB_LENGTH_TOO_SMALL", "GLB_UNEXPECTED_END_OF_CHUNK_DATA",
    "GLB_UNEXPECTED_END_OF_CHUNK_HEADER", "GLB_UNEXPECTED_END_OF_HEADER", "GLB_UNEXPECTED_FIRST_CHUNK",
    "INVALID_IBM_ACCESSOR_COUNT", "NODE_LOOP", "NODE_PARENT_OVERRIDE", "UNKNOWN_ASSET_MAJOR_VERSION",
}

# After these errors the image is still defined, and real exporters make them: the file must load.
LOAD = {
    "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "ACCESSOR_INVALID_SIGN",
    "ACCESSOR_JOINTS_INDEX_DUPLICATE", "ACCESSOR_MAX_MISMATCH", "ACCESSOR_MIN_MISMATCH", "ACCESSOR_NON_CLAMPED",
    "ACCESSOR_NORMALIZED_INVALID", "ACCESSOR_VECTOR3_NON_UNIT", "ACCESSOR_WEIGHTS_NEGATIVE",
    "ACCESSOR_WEIGHTS_NON_NORMALIZED", "ANIMATION_CHANNEL_TARGET_NODE_MATRIX",
    "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", "ANIMATION_DUPLICATE_TARGETS",
    "ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", "BUFFER_DATA_URI_MIME_TYPE_INVALID",
    "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", "CAMERA_ZFAR_LEQUAL_ZNEAR", "EMPTY_ENTITY", "GLB_UNEXPECTED_BIN_CHUNK",
    "IMAGE_DATA_INVALID", "IMAGE_MIME_TYPE_INVALID", "IMAGE_UNEXPECTED_EOS",
    "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE", "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH",
    "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", "MESH_INVALID_WEIGHTS_COUNT", "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
    "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", "MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR",
    "MESH_PRIMITIVE_NO_TANGENT_SPACE", "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "NODE_SKIN_WITH_NON_SKINNED_MESH",
    "NODE_WEIGHTS_INVALID", "ROTATION_NON_UNIT", "SKIN_NO_COMMON_ROOT", "TEXTURE_INVALID_IMAGE_MIME_TYPE",
    "UNDECLARED_EXTENSION", "UNEXPECTED_EXTENSION_OBJECT",
}


def expected_verdict(file):
    """Returns ("refuse" | "load" | None, codes) from the report beside `file`; None if both are allowed, or there is no
    report."""
    report = file.with_name(file.name + ".report.json")
    if not report.exists():
        return None, []
    messages = json.loads(report.read_text(encoding="utf-8"))["issues"]["messages"]
    codes = sorted({message["code"] for message in messages if message["severity"] == 0})
    if any(code in REFUSE for code in codes):
        return "refuse", codes
    return ("load" if codes and all(code in LOAD for code in codes) else None), codes


def shown(document):
    """Returns the document with all its meshes and skins in its scene, or None if nothing changes: many files do not
    use their faulty part."""
    try:
        result = copy.deepcopy(document)
        nodes = result.setdefault("nodes", [])
        used = {node.get("mesh") for node in nodes}
        skins = result.get("skins") or []
        added = []
        for index, mesh in enumerate(result.get("meshes") or []):
            if index in used:
                continue
            node = {"mesh": index}
            if skins and any("JOINTS_0" in primitive["attributes"] for primitive in mesh["primitives"]):
                node["skin"] = 0
            added.append(node)
        roots = set(range(len(nodes) + len(added))) - {child for node in nodes for child in node.get("children", [])}
        if not roots or (result.get("scenes") and not added):
            return None
        nodes += added
        result["scenes"] = [{"nodes": sorted(roots)}]
        result["scene"] = 0
        return result
    except (AttributeError, KeyError, TypeError):
        return None  # the faulty part is one of these


def read_document(file):
    """Returns the JSON of a text file, or None."""
    try:
        document = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
    except (ValueError, RecursionError):
        return None
    return document if isinstance(document, dict) else None
