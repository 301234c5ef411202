// What a client sends to a game over a live link: frames in portions of any size, and the messages in them.
#include "fxsdk/livelink/protocol/link_message.h"
#include "fxsdk/livelink/protocol/message_frame.h"
#include "tests/fuzz/fuzz_target.h"

namespace fx::fuzz {

namespace {

constexpr uint64_t kLongest = 1u << 16;

/// Whether a code is one that parseRequest() documents.
bool isDocumented(base::Code code)
{
    return code == base::Code::Parse || code == base::Code::Schema || code == base::Code::TooLarge;
}

void checkMessage(const std::string& message)
{
    require(!message.empty() && message.size() <= kLongest,
            "a message has at least 1 byte and at most its limit");
    uint64_t id = 0;
    const auto request = link::parseRequest(message, id);
    if (!request) {
        require(isDocumented(request.status().code()), "a request is refused with a documented code",
                request.status().message());
        require(!request.status().message().empty(), "a refused request has a message");
    } else if (request->type == link::RequestType::Replace) {
        const std::string written = link::textOf(
            link::replaceMessage(request->id, request->preset, request->text, request->restarts));
        const auto again = link::parseRequest(written, id);
        require(again.ok() && again->text == request->text && again->preset == request->preset &&
                    again->restarts == request->restarts,
                "a written request is read as it was");
    }
    const auto reply = link::parseReply(message);
    require(reply.ok() || isDocumented(reply.status().code()), "a reply is refused with a documented code");
}

/// Messages of a stream that arrives in portions of `portion` bytes, and whether the stream was refused.
std::vector<std::string> messagesOf(std::string_view stream, size_t portion, bool& outIsRefused)
{
    std::vector<std::string> messages;
    link::FrameReader reader(kLongest);
    outIsRefused = false;
    for (size_t at = 0; at < stream.size() && !outIsRefused; at += portion) {
        reader.add(stream.substr(at, portion));
        while (!outIsRefused) {
            auto message = reader.take();
            outIsRefused = !message.ok();
            if (outIsRefused || !*message)
                break;
            messages.push_back(std::move(**message));
        }
    }
    return messages;
}

} // namespace

/// The first byte chooses the size of the portions.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const size_t portion = 1 + reader.below(64);
    const std::string_view stream = textOf(reader.rest());
    bool isRefused = false, isRefusedWhole = false;
    const std::vector<std::string> messages = messagesOf(stream, portion, isRefused);
    const std::vector<std::string> whole = messagesOf(stream, stream.size() + 1, isRefusedWhole);
    require(messages == whole && isRefused == isRefusedWhole, "messages do not depend on portions");
    for (const std::string& message : messages)
        checkMessage(message);
    if (!stream.empty() && stream.size() <= kLongest)
        checkMessage(std::string(stream)); // so that inputs without a length reach the reader of messages
}

std::vector<std::string> seeds()
{
    const std::string hello = link::textOf(link::helloMessage("0123456789abcdef"));
    const std::string replace =
        link::textOf(link::replaceMessage(3, "fx/fire.fx.json", "{\"version\": 1}", true));
    const std::string list = R"({"type": "list", "id": 2})";
    return {
        "\x1f" + link::frameOf(hello) + link::frameOf(list) + link::frameOf(replace),
        std::string("\0", 1) + link::frameOf(list),
        "a" + replace,
        "a" + link::textOf(link::errorMessage(2, "schema", "line 1")),
        std::string("a\0\0\0\0", 5) + list,
        "a\xff\xff\xff\x7f" + list,
        "a" + std::string(100, '['),
    };
}

} // namespace fx::fuzz
