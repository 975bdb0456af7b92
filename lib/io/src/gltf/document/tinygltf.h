#pragma once

// tinygltf turns the checked document into structs, and does no more: TINYGLTF_NO_* in
// reading.cmake takes its file access and its image decoders away.
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>  // after the JSON library, which it does not include itself
