#pragma once

#include <bdpt/export.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace bdpt {

/// A list that never changes, so that its copies share it. To change an item one copies the values
/// to a vector, and makes a list of that.
template <typename T>
class SharedList {
public:
    SharedList() = default;
    /// Not explicit: values are a list.
    SharedList(std::vector<T> values)
        : values_(std::make_shared<const std::vector<T>>(std::move(values)))
    {}
    // No moves: there is always a list.
    SharedList(const SharedList&) = default;
    SharedList& operator=(const SharedList&) = default;
    ~SharedList() = default;

    [[nodiscard]] const std::vector<T>& values() const { return *values_; }
    /// Not explicit: a list is read as its values are, and a vector can be made of it.
    operator const std::vector<T>&() const { return *values_; }

    [[nodiscard]] bool empty() const { return values_->empty(); }
    [[nodiscard]] std::size_t size() const { return values_->size(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return (*values_)[i]; }
    [[nodiscard]] const T* data() const { return values_->data(); }
    [[nodiscard]] auto begin() const { return values_->begin(); }
    [[nodiscard]] auto end() const { return values_->end(); }

    /// Is it one of the copies of `other`?
    [[nodiscard]] bool is_shared_with(const SharedList& other) const
    {
        return values_ == other.values_;
    }

private:
    [[nodiscard]] static const std::shared_ptr<const std::vector<T>>& none()
    {
        static const auto values = std::make_shared<const std::vector<T>>();
        return values;
    }

    std::shared_ptr<const std::vector<T>> values_ = none();
};

/// A `SceneDesc` whose lists are shared by all copies: what a scene was built from, and what edits
/// begin with (`Scene::edited`).
struct BDPT_EXPORT SharedSceneDesc {
    SharedSceneDesc() = default;
    /// Not explicit: it says the same.
    SharedSceneDesc(SceneDesc desc);
    /// A copy of all lists, which is large for a large scene.
    [[nodiscard]] SceneDesc copy() const;

    /// All members, in the order of those of `SceneDesc`.
    [[nodiscard]] auto members() const
    {
        return std::tie(images, materials, meshes, instances, profiles, lights, texture_filter, fog,
                        volumes);
    }

    SharedList<TexelImage> images;
    SharedList<MaterialDesc> materials;
    SharedList<MeshDesc> meshes;
    SharedList<InstanceDesc> instances;
    SharedList<LightProfile> profiles;
    SharedList<LightDesc> lights;
    TextureFilter texture_filter = TextureFilter::bilinear;
    std::optional<MediumDesc> fog{};
    SharedList<VolumeDesc> volumes;
};

}  // namespace bdpt
