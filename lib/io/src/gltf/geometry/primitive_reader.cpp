#include "gltf/geometry/primitive_reader.h"

#include "file/uri.h"

#include <bdpt/error.h>

namespace bdpt::io {

PrimitiveReader::PrimitiveReader(const tinygltf::Model& model, PrimitiveId id)
    : model_(&model),
      source_(&model.meshes[id.mesh].primitives[id.primitive]),
      id_(id),
      name_(model.meshes[id.mesh].name)
{}

void PrimitiveReader::fail(std::string_view where, const std::string& what) const
{
    throw Error(ErrorCode::invalid_input, fmt::format("{}/{}: {}{}{}", id_.pointer(), where,
                                                      name_.empty() ? "" : "mesh " + quote(name_),
                                                      name_.empty() ? "" : ": ", what));
}

std::optional<int> PrimitiveReader::find(const Attributes& attributes, const std::string& semantic)
{
    const auto found = attributes.find(semantic);
    return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace bdpt::io
