#pragma once

// tinygltf converts the checked document to structs, and does nothing else: TINYGLTF_NO_* in
// reading.cmake disable its file access and its image decoders.
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>  // after the JSON library, which it does not include itself
