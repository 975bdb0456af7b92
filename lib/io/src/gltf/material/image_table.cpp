#include "gltf/material/image_table.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace bdpt::io {

namespace {

/// A failure that only loses one image, unlike `Error`.
struct UnreadableImage : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Bytes read_image_file(const std::string& uri, const LoadContext& context)
{
    const std::filesystem::path file = resolve_uri(context.folders, uri);
    try {
        return read_file(file, context.limits.file_bytes, std::numeric_limits<std::uint64_t>::max(),
                         &context.budget.memory());
    } catch (const Error& error) {
        if (error.code() == ErrorCode::not_found) {
            throw UnreadableImage(quote(uri) + ": " + error.what());
        }
        throw;
    }
}

}  // namespace

/// An image being loaded; its failure is kept until its turn.
struct ImageTable::Job {
    std::size_t index = 0;
    Bytes own_bytes{};  // if it is not in a buffer
    ByteView bytes{};
    std::optional<EncodedImage> encoded{};
    std::optional<ContentHash> hash{};  // hash of the bytes, if there is a cache
    DecodedImage decoded{};
    std::exception_ptr failure{};
    bool fatal = false;  // true: the failure ends the loading

    template <typename Work>
    void attempt(const Work& work)
    {
        try {
            work();
        } catch (const Error&) {
            failure = std::current_exception();
            fatal = true;
        } catch (const std::runtime_error&) {
            failure = std::current_exception();
        } catch (...) {
            failure = std::current_exception();
            fatal = true;
        }
    }

    [[nodiscard]] std::uint64_t memory() const
    {
        return own_bytes.size() + (encoded ? encoded->decoded_bytes() : 0);
    }
    [[nodiscard]] std::uint64_t process_memory() const
    {
        return encoded ? encoded->process_memory() : 0;
    }
};

/// Reads the bytes and the header. Memory is charged even if the image turns out to be broken, so
/// that the result does not depend on the order of decoding.
void ImageTable::open(Job& job)
{
    const tinygltf::Image& source = model_.images[job.index];
    if (source.bufferView >= 0) {
        const tinygltf::BufferView& view =
            model_.bufferViews[static_cast<std::size_t>(source.bufferView)];
        const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
        job.bytes = ByteView(data).subspan(view.byteOffset, view.byteLength);
    } else if (source.uri.empty()) {
        throw UnreadableImage("neither \"uri\" nor \"bufferView\"");
    } else {
        job.own_bytes = is_data_uri(source.uri)
                            ? decode_data_uri(source.uri, context_.limits.file_bytes)
                            : read_image_file(source.uri, context_);
        job.bytes = job.own_bytes;
        packed_bytes_ += job.own_bytes.size();
        if (packed_bytes_ > max_packed_bytes_) {
            context_.budget.memory().spend(
                "the packed image",
                packed_bytes_ - std::exchange(max_packed_bytes_, packed_bytes_));
        }
    }
    if (take_kept(job)) {
        spend(job.decoded.image.bytes.size());
        return;
    }
    job.encoded.emplace(job.bytes, context_.limits, context_.ktx2);
    spend(job.encoded->decoded_bytes());
    context_.budget.memory().check("decoding the image", job.process_memory());
}

/// Copies the image from the cache, if it is there.
bool ImageTable::take_kept(Job& job) const
{
    if (context_.images == nullptr) {
        return false;
    }
    ContentHasher hasher;
    hasher.add(job.bytes.data(), job.bytes.size());
    job.hash = hasher.hash();
    if (const TexelImage* const kept = context_.images->find(*job.hash)) {
        job.decoded.image = *kept;
        return true;
    }
    return false;
}

void ImageTable::spend(std::uint64_t bytes)
{
    total_bytes_ += bytes;
    if (total_bytes_ > context_.limits.texture_bytes) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("all images together need more than {}",
                        human_bytes(static_cast<long double>(context_.limits.texture_bytes))));
    }
    context_.budget.memory().spend("the image", bytes);
}

/// Decodes the images of a batch in parallel, and adds them in their order.
void ImageTable::finish(std::deque<Job>& batch, const std::function<void()>& tell)
{
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, batch.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                Job& job = batch[i];
                if (!job.failure && job.encoded) {
                    job.attempt([&job] { job.decoded = std::move(*job.encoded).decode(); });
                }
                job.encoded.reset();
                job.own_bytes = {};
                tell();
            }
        },
        tbb::simple_partitioner{});
    for (Job& job : batch) {
        add(job);
    }
    batch.clear();
    packed_bytes_ = 0;
}

void ImageTable::add(Job& job)
{
    const std::string place = fmt::format("/images/{}", job.index);
    std::optional<ImageId>& id = known_[job.index];
    try {
        if (job.failure) {
            std::rethrow_exception(job.failure);
        }
        const std::string& damage = job.decoded.damage;
        if (!damage.empty()) {
            context_.warn(WarningKind::loss,
                          "the image is damaged; the texture uses its decoded part",
                          place + ": " + damage);
        }
        for (const std::string& remark : job.decoded.remarks) {
            context_.warn("a KTX2 image that KHR_texture_basisu does not allow is used as it is",
                          place + ": " + remark);
        }
        // A damaged image is not cached, so that the warning is repeated when it is loaded again.
        if (job.hash && damage.empty() && job.decoded.remarks.empty()) {
            context_.images->keep(*job.hash, job.decoded.image);
        }
        id = static_cast<ImageId>(images_.size());
        if (job.decoded.encoding != ColorEncoding::unknown) {
            encodings_.emplace(*id, SaidEncoding{job.index, job.decoded.encoding});
        }
        images_.push_back(std::move(job.decoded.image));
    } catch (const Error& error) {
        throw Error(error.code(), place + ": " + error.what());
    } catch (const std::runtime_error& error) {
        context_.warn(WarningKind::loss, "the image cannot be read and is left out",
                      place + ": " + error.what());
    }
}

void ImageTable::decode(const std::vector<std::size_t>& indices,
                        const std::function<void(const LoadProgress&)>& on_progress)
{
    if (indices.empty()) {
        return;
    }
    LoadProgress progress{.images_done = 0, .images_total = indices.size()};
    std::mutex mutex;
    const auto tell = [&] {
        const std::lock_guard lock(mutex);
        ++progress.images_done;
        if (on_progress) {
            on_progress(progress);
        }
    };
    // Images are opened one after the other and decoded in batches, whose total memory is at most
    // that allowed for one image; and their processes together must fit into the budget.
    std::deque<Job> batch;
    std::uint64_t batch_memory = 0;
    std::uint64_t process_memory = 0;
    for (const std::size_t index : indices) {
        Job job{.index = index};
        job.attempt([&] { open(job); });
        if (!batch.empty() &&
            (job.memory() > context_.limits.image_bytes - batch_memory ||
             process_memory + job.process_memory() > context_.budget.memory().left())) {
            finish(batch, tell);
            batch_memory = 0;
            process_memory = 0;
            packed_bytes_ = job.own_bytes.size();
        }
        process_memory += job.process_memory();
        batch_memory = std::min(context_.limits.image_bytes, batch_memory + job.memory());
        const bool last = job.fatal;
        batch.push_back(std::move(job));
        if (last) {
            break;
        }
    }
    finish(batch, tell);
}

void ImageTable::check_encoding(ImageId id, ColorEncoding wanted)
{
    const auto found = encodings_.find(id);
    if (found != encodings_.end() && found->second.encoding != wanted) {
        const bool is_srgb = wanted == ColorEncoding::srgb;
        context_.warn(is_srgb ? "colours of a KTX2 image that says it is linear are read as sRGB"
                              : "data of a KTX2 image that says it is sRGB is read as linear",
                      fmt::format("/images/{}", found->second.index));
    }
}

std::optional<ImageId> ImageTable::get(std::size_t index)
{
    const auto found = known_.find(index);
    if (found != known_.end()) {
        return found->second;
    }
    decode({index}, {});
    return known_.at(index);
}

}  // namespace bdpt::io
