// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace spate::io;
using detail::Rgb;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

struct Decoded {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;

    Rgb at(double x, double y) const
    {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    bool operator==(Decoded const&) const = default;
};

class PictureTest : public testing::Test {
protected:
    void SetUp() override
    {
        const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        directory = fs::temp_directory_path() / ("spate_picture_" + test + "_" + std::to_string(::getpid()));
        fs::remove_all(directory);
        fs::create_directories(directory);
    }
    void TearDown() override { fs::remove_all(directory); }

    Decoded drawn(Picture const& picture, std::vector<Ball> const& balls) const
    {
        const fs::path file = directory / "a.png";
        write_png(file, picture, balls);
        Decoded out;
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << image.message;
        image.format = PNG_FORMAT_RGB;
        out.width = static_cast<int>(image.width);
        out.height = static_cast<int>(image.height);
        out.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
        EXPECT_NE(png_image_finish_read(&image, nullptr, out.pixels.data(), 0, nullptr), 0) << image.message;
        return out;
    }

    fs::path directory;
};

std::string content(fs::path const& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Looks at a known cube of space, so that the tests know which pixel shows what.
Picture sheet(int dim)
{
    Picture picture{
        .title = "t = 0.1 s", .value_name = "speed", .unit = "m/s", .dim = dim, .value_min = 0, .value_max = 1};
    picture.width = 500;
    picture.height = 400;
    picture.lower = {-1, -1, -1};
    picture.upper = {1, 1, 1};
    return picture;
}

/// The view that write_png chooses for that sheet.
detail::View view_of(Picture const& picture)
{
    const bool flat = picture.dim == 2;
    const detail::Box box = detail::bounds(picture, {});
    const Eigen::Matrix3d turn = flat ? Eigen::Matrix3d::Identity().eval() : detail::turn_toward(picture.seen_from);
    const detail::Canvas canvas(picture.width, picture.height, {255, 255, 255});
    return detail::lay_out(canvas, box, turn, {box, picture.axes, flat, 1},
                           {0, 1, picture.value_name, picture.unit, 1, false})
        .view;
}

Rgb colour_at(Decoded const& image, Picture const& picture, Eigen::Vector3d const& x)
{
    const detail::Point pixel = view_of(picture).place(x);
    return image.at(pixel.x(), pixel.y());
}

/// The hue is the colour map's, the brightness that of the light.
void expect_hue(Rgb seen, Rgb expected)
{
    const Eigen::Vector3d a = Eigen::Vector3d(seen.r, seen.g, seen.b).normalized();
    const Eigen::Vector3d b = Eigen::Vector3d(expected.r, expected.g, expected.b).normalized();
    EXPECT_GT(a.dot(b), 0.999) << a.transpose() << " and " << b.transpose();
    EXPECT_NE(seen, (Rgb{255, 255, 255}));
}

TEST_F(PictureTest, HasTheSizeAskedFor)
{
    const Decoded image = drawn({.width = 320, .height = 240}, {});
    EXPECT_EQ(image.width, 320);
    EXPECT_EQ(image.height, 240);
    EXPECT_EQ(drawn({}, {}).width, 1400);
    EXPECT_EQ(image.at(0, 0), (Rgb{255, 255, 255}));
}

TEST_F(PictureTest, ADiscHasTheColourOfItsValue)
{
    for (const float value : {0.0f, 0.3f, 1.0f}) {
        const Decoded image = drawn(sheet(2), {{{0.2f, -0.4f, 0}, 0.1f, value}});
        EXPECT_EQ(colour_at(image, sheet(2), {0.2, -0.4, 0}), detail::viridis(value));
        EXPECT_EQ(colour_at(image, sheet(2), {0.2, -0.27, 0}), (Rgb{255, 255, 255})); // to scale
    }
}

TEST_F(PictureTest, ASphereHasTheHueOfItsValue)
{
    for (const float value : {0.0f, 0.5f, 1.0f}) {
        const Decoded image = drawn(sheet(3), {{{0.2f, -0.4f, 0.1f}, 0.2f, value}});
        expect_hue(colour_at(image, sheet(3), {0.2, -0.4, 0.1}), detail::viridis(value));
    }
}

TEST_F(PictureTest, TheNearerBallWins)
{
    for (const bool swapped : {false, true}) {
        const Eigen::Vector3d toward = view_of(sheet(3)).toward();
        const auto shifted = [&](double d, float value) {
            const Eigen::Vector3f x = (d * toward).cast<float>();
            return Ball{{x[0], x[1], x[2]}, 0.2f, value};
        };
        std::vector<Ball> balls{shifted(0.3, 1.0f), shifted(-0.3, 0.0f)};
        if (swapped) std::swap(balls[0], balls[1]);
        expect_hue(colour_at(drawn(sheet(3), balls), sheet(3), {0, 0, 0}), detail::viridis(1));
    }
}

TEST_F(PictureTest, OverlappingDiscsShareTheLineBetweenThem)
{
    const Decoded image = drawn(sheet(2), {{{-0.2f, 0, 0}, 0.3f, 0}, {{0.2f, 0, 0}, 0.3f, 1}});
    EXPECT_EQ(colour_at(image, sheet(2), {-0.03, 0, 0}), detail::viridis(0));
    EXPECT_EQ(colour_at(image, sheet(2), {0.03, 0, 0}), detail::viridis(1));
}

TEST_F(PictureTest, GhostsAreGreyTranslucentOrLeftOut)
{
    Picture picture = sheet(3);
    const Eigen::Vector3f x = 0.5f * view_of(picture).toward().cast<float>();
    const std::vector<Ball> balls{{{0, 0, 0}, 0.2f, 1.0f}, {{x[0], x[1], x[2]}, 0.2f, 0, true}};
    const auto colour = [&](Ghosts ghosts) {
        picture.ghosts = ghosts;
        return colour_at(drawn(picture, balls), picture, {0, 0, 0});
    };
    const Rgb grey = colour(Ghosts::solid);
    EXPECT_EQ(grey.r, grey.b);
    expect_hue(colour(Ghosts::left_out), detail::viridis(1));
    EXPECT_GT(colour(Ghosts::translucent).b, colour(Ghosts::left_out).b); // yellow behind grey glass
    EXPECT_LT(colour(Ghosts::translucent).b, grey.b);
}

TEST_F(PictureTest, SameBallsGiveSameBytes)
{
    const std::vector<Ball> balls{{{0, 0, 0}, 0.2f, 1.0f}, {{0.3f, 0, 0}, 0.2f, 0.5f}, {{0, 0, 1}, 0.1f, 0, true}};
    for (auto* name : {"a.png", "b.png"}) write_png(directory / name, sheet(3), balls);
    EXPECT_EQ(content(directory / "a.png"), content(directory / "b.png"));
}

TEST_F(PictureTest, DrawsWhateverTheStateIs)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<std::vector<Ball>> states{
        {},
        {{{1, 2, 3}, 0, 5}},
        {{{nan_value, 0, 0}, 1, 0}, {{0, infinity, 0}, 1, 0}, {{0, 0, 0}, nan_value, 0}},
        {{{0, 0, 0}, 1, nan_value}, {{3, 0, 0}, 1, infinity}},
        {{{0, 0, 0}, 1e-6f, 1e30f}, {{1e6f, 1e6f, 1e6f}, 1e-6f, -1e30f}},
        {{{1e-9f, 0, 0}, 1e-10f, 1e-20f}, {{0, 0, 0}, 1e-10f, 2e-20f}},
        {{{1, 1, 1}, 1, 1000}, {{2, 1, 1}, 1, 1000}},
    };
    for (const int dim : {2, 3})
        for (std::size_t k = 0; k < states.size(); ++k) {
            Picture picture{.title = "any", .value_name = "value", .unit = "", .dim = dim, .width = 400, .height = 300};
            EXPECT_EQ(drawn(picture, states[k]).width, 400) << k;
        }
}

TEST_F(PictureTest, AValueThatIsNoNumberIsRed)
{
    const Decoded image = drawn(sheet(2), {{{0, 0, 0}, 0.2f, nan_value}});
    EXPECT_EQ(colour_at(image, sheet(2), {0, 0, 0}), detail::not_a_number);
}

TEST_F(PictureTest, AnyDirectionOfViewWorks)
{
    for (auto from : std::vector<std::array<double, 3>>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {-3, 2, -1}}) {
        Picture picture = sheet(3);
        picture.seen_from = from;
        const Decoded image = drawn(picture, {{{0, 0, 0}, 0.2f, 0.5f}});
        expect_hue(colour_at(image, picture, {0, 0, 0}), detail::viridis(0.5));
    }
}

TEST_F(PictureTest, RefusesWhatCannotBeDrawn)
{
    const auto refused = [&](auto change) {
        Picture picture;
        change(picture);
        EXPECT_THROW(write_png(directory / "a.png", picture, {}), std::invalid_argument);
    };
    refused([](Picture& p) { p.dim = 1; });
    refused([](Picture& p) { p.width = 10; });
    refused([](Picture& p) { p.height = 100'000; });
    refused([](Picture& p) { p.seen_from = {0, 0, 0}; });
    EXPECT_TRUE(fs::is_empty(directory));
}

TEST_F(PictureTest, AnUnwritablePlaceIsAnOutputErrorAndLeavesNothing)
{
    EXPECT_THROW(write_png(directory / "none" / "a.png", sheet(2), {}), spate::OutputError);
    fs::create_directories(directory / "b.png");
    EXPECT_THROW(write_png(directory / "b.png", sheet(2), {}), spate::OutputError);
    EXPECT_FALSE(fs::exists(directory / "b.png.tmp"));
}

TEST(Ticks, AreRoundAndInside)
{
    const detail::Ticks ticks = detail::ticks(-0.13, 0.62, 8);
    EXPECT_EQ(ticks.labels, (std::vector<std::string>{"-0.1", "0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6"}));
    EXPECT_EQ(detail::ticks(0, 1, 5).labels, (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    EXPECT_EQ(detail::ticks(0, 12000, 6).labels.back(), "12000");
    EXPECT_EQ(detail::ticks(-5e-6, 5e-6, 2).labels, (std::vector<std::string>{"-5", "0", "5"}));
    EXPECT_EQ(detail::ticks(-5e-6, 5e-6, 2).exponent, -6);
}

TEST(Viridis, IsExactAtItsKnotsAndStaysInside)
{
    EXPECT_EQ(detail::viridis(0), (Rgb{68, 1, 84}));
    EXPECT_EQ(detail::viridis(0.5), (Rgb{33, 145, 140}));
    EXPECT_EQ(detail::viridis(1), (Rgb{253, 231, 37}));
    EXPECT_EQ(detail::viridis(-3), detail::viridis(0));
    EXPECT_EQ(detail::viridis(1e30), detail::viridis(1));
}

TEST(Font, KnowsTwoByteSigns)
{
    EXPECT_EQ(detail::glyphs("m\u00B3/s").size(), 4u);
    EXPECT_EQ(detail::glyphs("\u03C1")[0], detail::glyph(U'\u03C1'));
    EXPECT_EQ(detail::glyphs("\xC3").size(), 1u); // a broken text is no reason to lose a picture
}

} // namespace
