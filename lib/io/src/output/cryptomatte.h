#pragma once

#include <OpenEXR/ImfHeader.h>
#include <bdpt/film/id_film.h>

#include <span>

namespace bdpt::io {

/// Adds the metadata that readers of Cryptomatte look for to `header`, for those layers that it has
/// channels of: "cryptomatte/KEY/name", ".../hash", ".../conversion" and ".../manifest"
/// [Cryptomatte specification 1.2.0, "Metadata"].
void add_cryptomatte_metadata(Imf::Header& header, std::span<const IdManifest> manifests);

}  // namespace bdpt::io
