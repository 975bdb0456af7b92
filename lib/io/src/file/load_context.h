#pragma once

#include "file/data_budget.h"
#include "file/uri.h"
#include "file/warnings.h"

#include <bdpt/io/gltf.h>
#include <bdpt/io/read_limits.h>

#include <memory>
#include <string>

namespace bdpt::io {

class Ktx2Decoder;  // image/ktx2_decoder.h

/// State shared by all steps of loading one file.
struct LoadContext {
    SceneFolders folders{};
    ReadLimits limits{};
    std::shared_ptr<MemoryBudget> memory{};  ///< budget of the caller, if any
    DataBudget budget{limits, memory};
    Warnings warnings{};
    ImageCache* images = nullptr;  ///< shared with other loads, if any
    Ktx2Decoder* ktx2 = nullptr;   ///< null: KTX2 images are not decoded
    bool ignore_required = false;  ///< `GltfOptions::ignore_required`

    /// Adds a warning about something harmless.
    void warn(const std::string& text, const std::string& place) { warnings.add(text, place); }
    void warn(WarningKind kind, const std::string& text, const std::string& place)
    {
        warnings.add(kind, text, place);
    }
};

}  // namespace bdpt::io
