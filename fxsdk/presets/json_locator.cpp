#include "fxsdk/presets/json_locator.h"

#include "fxsdk/presets/json_sax.h"

#include <nlohmann/json.hpp>

#include <unordered_map>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

class Locator final : public nlohmann::json_sax<Json>
{
public:
    Locator(std::string_view text, std::unordered_map<std::string, JsonPlace>& wanted)
        : path_(text), wanted_(wanted)
    {}

    void run() { static_cast<void>(Json::sax_parse(path_.begin(), path_.end(), this)); }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return enter(false); }
    bool start_array(std::size_t) override { return enter(true); }
    bool end_object() override { return leave(); }
    bool end_array() override { return leave(); }
    bool key(string_t& name) override
    {
        keyOffset_ = path_.beginToken();
        path_.key(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override
    {
        return false;
    }

private:
    bool value()
    {
        const size_t offset = path_.beginToken();
        path_.value();
        const auto found = wanted_.find(path_.pointer());
        if (found != wanted_.end() && found->second.value == kNowhere) {
            found->second = {path_.depth() == 0 || path_.insideArray() ? offset : keyOffset_, offset};
            ++foundCount_;
        }
        return foundCount_ < wanted_.size(); // nothing left to look for: stop reading
    }
    bool enter(bool isArray)
    {
        const bool goesOn = value();
        path_.enter(isArray);
        return goesOn && path_.depth() <= kDeepest;
    }
    bool leave()
    {
        path_.beginToken();
        path_.leave();
        return true;
    }

public:
    static constexpr size_t kNowhere = ~size_t(0);

private:
    static constexpr size_t kDeepest = 64; ///< deeper than any document that is accepted

    JsonPath path_;
    size_t keyOffset_ = 0;
    size_t foundCount_ = 0;
    std::unordered_map<std::string, JsonPlace>& wanted_;
};

std::string parentOf(const std::string& pointer)
{
    const size_t slash = pointer.rfind('/');
    return slash == std::string::npos ? std::string() : pointer.substr(0, slash);
}

} // namespace

std::vector<JsonPlace> locateJson(std::string_view text, std::span<const std::string> pointers)
{
    constexpr JsonPlace kNowhere{Locator::kNowhere, Locator::kNowhere};
    std::unordered_map<std::string, JsonPlace> wanted;
    for (std::string pointer : pointers)
        for (; wanted.emplace(pointer, kNowhere).second && !pointer.empty(); pointer = parentOf(pointer)) {
        }
    wanted.emplace("", kNowhere);
    Locator(text, wanted).run();

    std::vector<JsonPlace> places;
    for (std::string pointer : pointers) {
        while (wanted[pointer].value == Locator::kNowhere && !pointer.empty())
            pointer = parentOf(pointer);
        const JsonPlace place = wanted[pointer];
        places.push_back(place.value == Locator::kNowhere ? JsonPlace{} : place);
    }
    return places;
}

} // namespace fx::preset
