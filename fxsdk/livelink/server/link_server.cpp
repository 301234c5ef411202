#include "fxsdk/livelink/server/link_server.h"

#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_reload.h"
#include "fxsdk/livelink/server/scene_list.h"

#include <algorithm>
#include <array>
#include <unistd.h>
#include <utility>

namespace fx::link {

namespace {

using Json = nlohmann::json;

constexpr size_t kAccepts = 4;                ///< connections that an update accepts
constexpr size_t kJobs = 4;                   ///< messages that may wait for the worker
constexpr size_t kOutBytes = size_t(4) << 20; ///< above, nothing is read before the client reads
constexpr std::chrono::seconds kHelloTime{5};
constexpr std::chrono::seconds kMessageTime{30};

std::string codeOf(FxResult result)
{
    return fxResultName(result);
}

/// Takes the same time for all texts of one length.
bool isEqual(const std::string& given, const std::string& secret)
{
    if (given.size() != secret.size())
        return false;
    unsigned difference = 0;
    for (size_t i = 0; i < given.size(); ++i)
        difference |= static_cast<unsigned char>(given[i]) ^
                      static_cast<unsigned>(static_cast<unsigned char>(secret[i]));
    return difference == 0;
}

} // namespace

LinkServer::LinkServer(FxContext* context, ServerOptions options, Socket listener, Address address)
    : context_(context), options_(std::move(options)), listener_(std::move(listener)),
      address_(std::move(address)), worker_(context, !options_.loadsOnUpdate)
{}

LinkServer::~LinkServer()
{
    if (!address_.isTcp())
        (void)unlink(address_.path.c_str());
}

FxLiveLinkStatistics LinkServer::statistics() const
{
    FxLiveLinkStatistics now = counts_;
    now.hasClient = client_ && client_->isKnown ? 1 : 0;
    return now;
}

void LinkServer::update(std::span<FxScene* const> scenes)
{
    ++updates_;
    messagesLeft_ = options_.messagesPerUpdate;
    finishJobs(scenes);
    acceptClients();
    if (client_)
        readClient();
    if (options_.loadsOnUpdate)
        finishJobs(scenes);
    if (client_)
        writeClient();
}

/// The first client stays; others get a message.
void LinkServer::acceptClients()
{
    for (size_t i = 0; i < kAccepts; ++i) {
        std::optional<Socket> socket = listener_.accept(address_.isTcp());
        if (!socket)
            return;
        ++counts_.clients;
        if (!client_) {
            client_ = std::make_unique<Client>(std::move(*socket), counts_.clients);
            client_->deadline = Clock::now() + kHelloTime;
            continue;
        }
        ++counts_.refused;
        (void)socket->send(frameOf(textOf(errorMessage(
            0, "busy", "another client is connected to this game; a game serves one at a time"))));
    }
}

void LinkServer::readClient()
{
    std::array<char, 65536> chunk;
    uint64_t left = options_.bytesPerUpdate;
    takeMessages();
    while (client_ && !client_->isLeaving && left > 0 && messagesLeft_ > 0 && worker_.unfinished() < kJobs &&
           client_->out.size() < kOutBytes)
    {
        const base::Result<size_t> count =
            client_->socket.receive(chunk.data(), size_t(std::min<uint64_t>(left, chunk.size())));
        if (!count)
            return closeClient();
        if (*count == 0)
            break;
        left -= *count;
        counts_.bytesRead += *count;
        client_->reader.add({chunk.data(), *count});
        takeMessages();
    }
    if (!client_ || client_->isLeaving)
        return;
    const bool waits = !client_->isKnown || client_->reader.isInMessage();
    const bool isHeldUp = worker_.unfinished() >= kJobs || messagesLeft_ == 0; // by the game itself
    if (!waits || isHeldUp) {
        client_->hasDeadline = false;
    } else if (!client_->hasDeadline) {
        client_->hasDeadline = true;
        client_->deadline = Clock::now() + kMessageTime;
    } else if (Clock::now() > client_->deadline) {
        refuse("timeout", client_->isKnown ? "the rest of the message has not arrived within 30 s"
                                           : "no hello has arrived within 5 s");
    }
}

/// Takes complete messages as far as this update may.
void LinkServer::takeMessages()
{
    while (client_ && !client_->isLeaving && messagesLeft_ > 0 && worker_.unfinished() < kJobs) {
        base::Result<std::optional<std::string>> message = client_->reader.take();
        if (!message)
            return refuse(codeOf(FxResult(int(message.status().code()))), message.status().message());
        if (!*message)
            return;
        --messagesLeft_;
        ++counts_.messages;
        client_->hasDeadline = false;
        takeMessage(std::move(**message));
    }
}

void LinkServer::takeMessage(std::string message)
{
    if (!client_->isKnown)
        return greet(message);
    worker_.add({client_->connection, updates_, std::move(message)});
}

/// The first message, which is short.
void LinkServer::greet(const std::string& message)
{
    uint64_t id = 0;
    const base::Result<Request> request = parseRequest(message, id);
    if (!request)
        return refuse(codeOf(FxResult(int(request.status().code()))), request.status().message());
    if (request->type != RequestType::Hello)
        return refuse("hello", "the first message must be a hello");
    if (request->protocol != kProtocol)
        return refuse("version",
                      "this game speaks version " + std::to_string(kProtocol) + " of the protocol");
    if (!options_.token.empty() && !isEqual(request->token, options_.token))
        return refuse("token", "the token is wrong");
    client_->isKnown = true;
    client_->reader.setLimit(options_.maxMessageBytes);
    send({{"type", "hello"},
          {"protocol", kProtocol},
          {"name", options_.name},
          {"pid", int64_t(getpid())},
          {"maxMessageBytes", options_.maxMessageBytes}});
}

/// Sends a last message and closes the connection.
void LinkServer::refuse(const std::string& code, const std::string& why)
{
    ++counts_.refused;
    send(errorMessage(0, code, why));
    client_->isLeaving = true;
}

void LinkServer::send(const Json& message)
{
    if (message["type"] == "error")
        ++counts_.errors;
    client_->out += frameOf(textOf(message));
}

void LinkServer::writeClient()
{
    Client& client = *client_;
    uint64_t left = options_.bytesPerUpdate;
    while (!client.out.empty() && left > 0) {
        const base::Result<size_t> count = client.socket.send(
            std::string_view(client.out).substr(0, size_t(std::min<uint64_t>(left, client.out.size()))));
        if (!count)
            return closeClient();
        if (*count == 0) {
            if (client.isLeaving)
                closeClient(); // it has had its chance to read
            return;
        }
        left -= *count;
        counts_.bytesWritten += *count;
        client.out.erase(0, *count);
    }
    if (client.out.empty() && client.isLeaving)
        closeClient();
}

void LinkServer::finishJobs(std::span<FxScene* const> scenes)
{
    while (std::optional<DoneJob> job = worker_.take()) {
        struct Unload // whatever happens
        {
            LinkServer& server;
            FxPresetId preset;
            ~Unload()
            {
                if (preset.bits == 0)
                    return;
                (void)fxUnloadPreset(server.context_, preset);
                server.worker_.forget(preset);
            }
        } unload{*this, job->preset};
        if (client_ && client_->connection == job->connection && !client_->isLeaving)
            answer(*job, scenes);
    }
}

void LinkServer::answer(const DoneJob& job, std::span<FxScene* const> scenes)
{
    if (!job.request) {
        send(errorMessage(job.id, codeOf(FxResult(int(job.request.status().code()))),
                          job.request.status().message()));
        return;
    }
    if (job.loadResult != FX_OK)
        return send(errorMessage(job.id, codeOf(job.loadResult), job.loadMessage));
    switch (job.request->type) {
    case RequestType::Hello:
        return send(errorMessage(job.id, "hello", "the client has said hello already"));
    case RequestType::List:
        return send(sceneList(job.id, context_, worker_.listPresets(), scenes));
    case RequestType::Replace:
        return send(replace(job, scenes));
    }
}

/// Replaces presets in all scenes and behind their ids.
Json LinkServer::replace(const DoneJob& job, std::span<FxScene* const> scenes)
{
    const uint32_t mode = job.request->restarts ? FX_REPLACE_RESTART : FX_REPLACE_SEEK;
    uint64_t instances = 0;
    for (const FxPresetId old : job.replaced) {
        for (size_t i = 0; i < scenes.size(); ++i) {
            uint32_t count = 0;
            const FxResult result = fxScene_ReplacePreset(scenes[i], old, job.preset, mode, &count);
            if (result != FX_OK) {
                const std::string why = fxGetLastErrorMessage();
                for (size_t j = 0; j < i; ++j) // no preset of a game is replaced in half of its scenes
                    (void)fxScene_ReplacePreset(scenes[j], job.preset, old, FX_REPLACE_SEEK, nullptr);
                return errorMessage(job.id, codeOf(result), why);
            }
            instances += count;
        }
        if (const FxResult result = fxRedirectPreset(context_, old, job.preset); result != FX_OK)
            return errorMessage(job.id, codeOf(result), fxGetLastErrorMessage());
    }
    ++counts_.replacements;
    return {{"type", "replaced"},
            {"id", job.id},
            {"preset", job.source},
            {"instances", instances},
            {"frames", updates_ - job.received + 1},
            {"milliseconds", job.milliseconds}};
}

} // namespace fx::link
