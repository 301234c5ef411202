#include "fxsdk/livelink/server/preset_worker.h"

#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_reload.h"
#include "fxsdk/livelink/server/preset_match.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace fx::link {

std::string sourceOf(FxContext* context, FxPresetId preset)
{
    size_t size = 0;
    if (fxGetPresetSource(context, preset, nullptr, 0, &size) != FX_OK)
        return {};
    std::string text(size, '\0');
    if (fxGetPresetSource(context, preset, text.data(), text.size(), &size) != FX_OK || size > text.size())
        return {};
    text.resize(size - 1);
    return text;
}

PresetWorker::PresetWorker(FxContext* context, bool hasThread) : context_(context)
{
    if (hasThread)
        thread_ = std::thread([this] { work(); });
}

PresetWorker::~PresetWorker()
{
    {
        std::lock_guard lock(mutex_);
        isOver_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable())
        thread_.join();
    for (const DoneJob& job : done_)
        if (job.preset.bits != 0)
            (void)fxUnloadPreset(context_, job.preset);
}

void PresetWorker::add(Job job)
{
    if (!thread_.joinable()) {
        keep(finish(std::move(job)));
        return;
    }
    {
        std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(job));
    }
    wake_.notify_one();
}

std::optional<DoneJob> PresetWorker::take()
{
    std::lock_guard lock(mutex_);
    if (done_.empty())
        return std::nullopt;
    std::optional<DoneJob> job(std::move(done_.front()));
    done_.pop_front();
    return job;
}

size_t PresetWorker::unfinished()
{
    std::lock_guard lock(mutex_);
    return waiting_.size() + working_ + done_.size();
}

void PresetWorker::forget(FxPresetId preset)
{
    std::lock_guard lock(mutex_);
    std::erase(loaded_, preset.bits);
}

std::vector<FxPresetId> PresetWorker::listPresets()
{
    std::lock_guard lock(mutex_);
    std::vector<FxPresetId> presets;
    uint32_t count = 0;
    for (int attempt = 0; attempt < 8; ++attempt) { // the host may load presets meanwhile
        if (fxGetPresets(context_, nullptr, 0, &count) != FX_OK)
            return {};
        presets.resize(size_t(count) + 8);
        if (fxGetPresets(context_, presets.data(), uint32_t(presets.size()), &count) == FX_OK)
            break;
        count = 0;
    }
    presets.resize(count);
    const auto has = [](const std::vector<uint64_t>& list, FxPresetId preset) {
        return std::find(list.begin(), list.end(), preset.bits) != list.end();
    };
    std::erase_if(presets, [&](FxPresetId preset) {
        return has(loaded_, preset) || (isLoading_ && !has(known_, preset));
    });
    return presets;
}

void PresetWorker::work()
{
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return isOver_ || !waiting_.empty(); });
        if (isOver_)
            return;
        Job job = std::move(waiting_.front());
        waiting_.pop_front();
        working_ = 1;
        lock.unlock();
        keep(finish(std::move(job)));
        lock.lock();
    }
}

/// Without memory for it, a result is lost: the client gets no reply.
void PresetWorker::keep(DoneJob done)
{
    std::lock_guard lock(mutex_);
    working_ = 0;
    try {
        done_.push_back(std::move(done));
    } catch (const std::bad_alloc&) {
        (void)fxUnloadPreset(context_, done.preset);
        std::erase(loaded_, done.preset.bits);
    }
}

DoneJob PresetWorker::finish(Job job) noexcept
{
    DoneJob done;
    done.connection = job.connection;
    done.received = job.received;
    try {
        done.request = parseRequest(job.message, done.id);
        job.message.clear();
        job.message.shrink_to_fit();
        if (done.request && done.request->type == RequestType::Replace)
            load(done);
    } catch (const std::bad_alloc&) {
        done.loadResult = FX_ERROR_OUT_OF_MEMORY;
    } catch (...) {
        done.loadResult = FX_ERROR_INTERNAL;
    }
    return done;
}

/// Loads the text of a replacement for the presets that it names.
void PresetWorker::load(DoneJob& io)
{
    const auto start = std::chrono::steady_clock::now();
    const Request& request = *io.request;
    const std::vector<FxPresetId> ids = listPresets();
    std::vector<NamedPreset> presets;
    for (const FxPresetId id : ids) {
        FxPresetInfo info{};
        info.structSize = sizeof info;
        const bool isLoaded = fxGetPresetInfo(context_, id, &info) == FX_OK;
        presets.push_back({sourceOf(context_, id), isLoaded ? info.name : ""});
    }
    const base::Result<std::vector<size_t>> found = matchPreset(request.preset, presets);
    if (!found) {
        io.loadResult = FxResult(int(found.status().code()));
        io.loadMessage = found.status().message();
        return;
    }
    for (const size_t index : *found)
        io.replaced.push_back(ids[index]);
    io.source = presets[found->front()].source;
    {
        std::lock_guard lock(mutex_);
        loaded_.reserve(loaded_.size() + 1);
        known_.clear();
        for (const FxPresetId id : ids)
            known_.push_back(id.bits);
        isLoading_ = true;
    }
    io.loadResult =
        fxLoadPresetTextAt(context_, request.text.data(), request.text.size(), io.source.c_str(), &io.preset);
    {
        std::lock_guard lock(mutex_);
        if (io.loadResult == FX_OK)
            loaded_.push_back(io.preset.bits);
        isLoading_ = false;
    }
    if (io.loadResult != FX_OK) {
        io.loadMessage = fxGetLastErrorMessage();
        return;
    }
    io.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace fx::link
