#include "fxsdk/livelink/protocol/link_message.h"

#include "fxsdk/livelink/protocol/message_frame.h"
#include "fxsdk/presets/json_parser.h"

#include <array>
#include <optional>
#include <utility>

namespace fx::link {

namespace {

using Json = nlohmann::json;

constexpr uint64_t kDocumentBytes = 4 * kLargestMessage; ///< [byte] in memory; strings may be escaped
constexpr preset::JsonLimits kRequestLimits{kLargestMessage, 8, 256, kLargestMessage, 64, kDocumentBytes};
constexpr preset::JsonLimits kReplyLimits{kLargestMessage, 8,      200'000,
                                          kLargestMessage, 20'000, kDocumentBytes};

constexpr std::array<std::pair<std::string_view, RequestType>, 3> kTypes{{
    {"hello", RequestType::Hello},
    {"list", RequestType::List},
    {"replace", RequestType::Replace},
}};

base::Result<Json> parse(std::string_view message, const preset::JsonLimits& limits)
{
    preset::Findings findings;
    std::optional<Json> document = preset::parseJson(message, limits, findings);
    if (!document)
        return base::Status(findings.firstCode(), preset::summary(findings.locate(message, "message")));
    if (!document->is_object())
        return base::Status(base::Code::Schema, "the message is not a JSON object");
    return std::move(*document);
}

/// Reads members of a message; the first fault stays.
class Members
{
public:
    explicit Members(const Json& message) : message_(message) {}

    std::string text(const char* name, bool isRequired)
    {
        const Json* const value = find(name, isRequired);
        if (value && !value->is_string())
            fail(name, "a string");
        return value && value->is_string() ? value->get<std::string>() : std::string();
    }
    uint64_t number(const char* name, bool isRequired)
    {
        const Json* const value = find(name, isRequired);
        if (value && !value->is_number_unsigned())
            fail(name, "a whole number from 0 on");
        return value && value->is_number_unsigned() ? value->get<uint64_t>() : 0;
    }
    void fail(const char* name, const char* what)
    {
        if (status_.ok())
            status_ = {base::Code::Schema, "member \"" + std::string(name) + "\" must be " + what};
    }
    const base::Status& status() const { return status_; }

private:
    const Json* find(const char* name, bool isRequired)
    {
        const auto found = message_.find(name);
        if (found != message_.end())
            return &*found;
        if (isRequired && status_.ok())
            status_ = {base::Code::Schema, "member \"" + std::string(name) + "\" is missing"};
        return nullptr;
    }

    const Json& message_;
    base::Status status_;
};

void readReplacement(Members& members, Request& request)
{
    request.preset = members.text("preset", true);
    request.text = members.text("text", true);
    const std::string mode = members.text("mode", false);
    request.restarts = mode == "restart";
    if (!mode.empty() && mode != "restart" && mode != "seek")
        members.fail("mode", "\"seek\" or \"restart\"");
    if (members.status().ok() && request.preset.empty())
        members.fail("preset", "the name of a preset");
    if (members.status().ok() && request.text.empty())
        members.fail("text", "the text of a preset");
}

} // namespace

base::Result<Request> parseRequest(std::string_view message, uint64_t& outId)
{
    outId = 0;
    const base::Result<Json> document = parse(message, kRequestLimits);
    if (!document)
        return document.status();
    Members members(*document);
    Request request;
    request.id = outId = members.number("id", false);
    const std::string type = members.text("type", true);
    bool isKnown = false;
    for (const auto& [name, value] : kTypes)
        if (name == type) {
            request.type = value;
            isKnown = true;
        }
    if (!isKnown)
        members.fail("type", "\"hello\", \"list\" or \"replace\"");
    if (request.type == RequestType::Hello) {
        request.protocol = members.number("protocol", isKnown);
        request.token = members.text("token", false);
    } else if (request.type == RequestType::Replace) {
        readReplacement(members, request);
    }
    return members.status().ok() ? base::Result<Request>(std::move(request)) : members.status();
}

base::Result<Json> parseReply(std::string_view message)
{
    base::Result<Json> document = parse(message, kReplyLimits);
    if (!document)
        return document;
    Members members(*document);
    (void)members.text("type", true);
    (void)members.number("id", false);
    return members.status().ok() ? std::move(document) : members.status();
}

std::string textOf(const Json& message)
{
    return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json helloMessage(const std::string& token)
{
    Json message{{"type", "hello"}, {"protocol", kProtocol}};
    if (!token.empty())
        message["token"] = token;
    return message;
}

Json replaceMessage(uint64_t id, const std::string& preset, const std::string& text, bool restarts)
{
    return {{"type", "replace"},
            {"id", id},
            {"preset", preset},
            {"text", text},
            {"mode", restarts ? "restart" : "seek"}};
}

Json errorMessage(uint64_t id, const std::string& code, const std::string& message)
{
    Json error{{"type", "error"}, {"code", code}, {"message", message}};
    if (id != 0)
        error["id"] = id;
    return error;
}

} // namespace fx::link
