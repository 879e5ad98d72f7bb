// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief A text file line by line, with the sentences for a line that cannot be read: file and line number first.
#pragma once

#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "spate/core/errors.hpp"

namespace spate::io::detail {

inline std::string_view trimmed(std::string_view s)
{
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!s.empty() && blank(s.front())) s.remove_prefix(1);
    while (!s.empty() && blank(s.back())) s.remove_suffix(1);
    return s;
}
/// The number that the whole word is.
template <class T>
bool reads_as(std::string_view word, T& value)
{
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    return read.ec == std::errc() && read.ptr == word.data() + word.size();
}

/// The lines of a file less what follows a #; those with nothing on them are passed over, but counted.
class Lines {
public:
    [[gnu::cold]] explicit Lines(std::filesystem::path file) : file_(std::move(file))
    {
        errno = 0;
        in_.open(file_);
        // A directory opens, but no line of it can be read.
        if (!in_ || (in_.peek() == std::ifstream::traits_type::eof() && errno != 0))
            throw BadInput("the start file " + file_.string(),
                           errno != 0 ? std::generic_category().message(errno) : "not readable", "a file to be read");
    }
    /// Whether there was one more.
    bool next()
    {
        while (std::getline(in_, whole_)) {
            ++number_;
            text_ = whole_;
            text_ = trimmed(text_.substr(0, text_.find('#')));
            if (!text_.empty()) return true;
        }
        text_ = {};
        return false;
    }
    /// The next line, whatever stands on it.
    std::string any()
    {
        text_ = {};
        if (!std::getline(in_, whole_)) return "";
        ++number_;
        return whole_;
    }
    /// What follows a # in the line in hand.
    [[nodiscard]] std::string_view comment() const
    {
        const std::size_t at = whole_.find('#');
        return at == whole_.npos ? std::string_view() : trimmed(std::string_view(whole_).substr(at + 1));
    }
    /// Of the line in hand, without blanks at its ends.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// The words between commas.
    [[nodiscard]] std::vector<std::string_view> cells() const
    {
        std::vector<std::string_view> all;
        for (std::size_t at = 0;;) {
            const std::size_t end = text_.find(',', at);
            all.push_back(trimmed(text_.substr(at, end == text_.npos ? text_.npos : end - at)));
            if (end == text_.npos) return all;
            at = end + 1;
        }
    }
    /// The words between blanks.
    [[nodiscard]] std::vector<std::string_view> words() const
    {
        std::vector<std::string_view> all;
        for (std::size_t at = 0; (at = text_.find_first_not_of(" \t", at)) != text_.npos;) {
            const std::size_t end = text_.find_first_of(" \t", at);
            all.push_back(text_.substr(at, end == text_.npos ? text_.npos : end - at));
            at = end == text_.npos ? text_.size() : end;
        }
        return all;
    }
    [[nodiscard]] double number(std::string_view word, std::string const& what) const
    {
        double value = 0;
        if (!reads_as(word, value) || !std::isfinite(value)) refuse(what, quoted(word), "a finite number");
        return value;
    }
    [[nodiscard]] std::int64_t whole_number(std::string_view word, std::string const& what) const
    {
        std::int64_t value = 0;
        if (!reads_as(word, value)) refuse(what, quoted(word), "a whole number");
        return value;
    }
    static std::string quoted(std::string_view word)
    {
        std::string q = "\"";
        q += word;
        q += '"';
        return q;
    }
    [[noreturn, gnu::cold]] void refuse(std::string const& what, std::string const& is,
                                        std::string const& allowed) const
    {
        throw BadInput(what + " in line " + std::to_string(number_) + " of " + file_.string(), is, allowed);
    }
    [[noreturn, gnu::cold]] void refuse_file(std::string const& is, std::string const& allowed) const
    {
        throw BadInput("the start file " + file_.string(), is, allowed);
    }

private:
    std::filesystem::path file_;
    std::ifstream in_;
    std::string whole_;
    std::string_view text_;
    std::int64_t number_ = 0;
};

} // namespace spate::io::detail
