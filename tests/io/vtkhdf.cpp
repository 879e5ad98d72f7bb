// SPDX-License-Identifier: BSD-3-Clause
#include "spate/io/vtkhdf.hpp"

#include "io/small_tank.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace spate::io;

class Vtkhdf : public testing::Test {
protected:
    void SetUp() override
    {
        const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        directory = fs::temp_directory_path() / ("spate_vtkhdf_" + test + "_" + std::to_string(::getpid()));
        fs::remove_all(directory);
        fs::create_directories(directory);
    }
    void TearDown() override { fs::remove_all(directory); }

    std::size_t files() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
    }

    fs::path directory;
};

std::string content(fs::path const& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Cloud line_of(std::size_t n)
{
    Cloud cloud{.time = 0.1,
                .step = 42,
                .points = {},
                .columns = {{"velocity", 3, {}}, {"radius", 1, {}}},
                .id = {},
                .species = {}};
    cloud.integers.push_back({"contacts", {}});
    for (std::size_t k = 0; k < n; ++k) {
        const auto x = static_cast<float>(k);
        cloud.points.insert(cloud.points.end(), {x, 2 * x, 3 * x});
        cloud.columns[0].values.insert(cloud.columns[0].values.end(), {-x, 0.5f, x});
        cloud.columns[1].values.push_back(0.25f + x);
        cloud.id.push_back(1'000'000'000'000 + static_cast<std::int64_t>(k));
        cloud.species.push_back(static_cast<std::uint8_t>(k % 2));
        cloud.integers[0].values.push_back(-static_cast<std::int64_t>(k));
    }
    return cloud;
}

struct Reader {
    explicit Reader(fs::path const& path) : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
    Reader(Reader const&) = delete;
    Reader& operator=(Reader const&) = delete;
    ~Reader() { H5Fclose(file); }

    std::vector<hsize_t> shape(std::string const& name) const
    {
        const hid_t set = H5Dopen2(file, ("/VTKHDF/" + name).c_str(), H5P_DEFAULT);
        const hid_t space = H5Dget_space(set);
        std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
        H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
        H5Sclose(space);
        H5Dclose(set);
        return sizes;
    }

    template <class T>
    std::vector<T> values(std::string const& name) const
    {
        std::size_t count = 1;
        for (const hsize_t size : shape(name)) count *= size;
        std::vector<T> out(count);
        const hid_t set = H5Dopen2(file, ("/VTKHDF/" + name).c_str(), H5P_DEFAULT);
        const hid_t type = H5Dget_type(set);
        EXPECT_GT(H5Tequal(type, detail::hdf5_type(T{})), 0) << name;
        if (count > 0) {
            EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), 0) << name;
        }
        H5Tclose(type);
        H5Dclose(set);
        return out;
    }

    hid_t file;
};

using Shape = std::vector<hsize_t>;

void expect_layout(Reader const& read, std::size_t n)
{
    const std::vector<std::int64_t> count{static_cast<std::int64_t>(n)};
    for (auto* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
        EXPECT_EQ(read.shape(name), Shape{1}) << name;
        EXPECT_EQ(read.values<std::int64_t>(name), count) << name;
    }
    std::vector<std::int64_t> offsets;
    for (std::size_t k = 0; k <= n; ++k) offsets.push_back(static_cast<std::int64_t>(k));
    EXPECT_EQ(read.values<std::int64_t>("Offsets"), offsets);
    offsets.pop_back();
    EXPECT_EQ(read.values<std::int64_t>("Connectivity"), offsets);
    EXPECT_EQ(read.values<std::uint8_t>("Types"), std::vector<std::uint8_t>(n, 1));
    EXPECT_EQ(read.shape("Points"), (Shape{n, 3}));
    EXPECT_EQ(read.shape("PointData/velocity"), (Shape{n, 3}));
    for (auto* name : {"radius", "id", "species", "contacts"}) {
        EXPECT_EQ(read.shape("PointData/" + std::string(name)), Shape{n}) << name;
    }
}

TEST_F(Vtkhdf, HoldsWhatTheCloudHeld)
{
    const Cloud cloud = line_of(70'001); // more than one chunk of the compressed arrays
    write_vtkhdf(directory / "a.hdf", cloud);
    const Reader read(directory / "a.hdf");
    expect_layout(read, cloud.size());
    EXPECT_EQ(read.values<float>("Points"), cloud.points);
    EXPECT_EQ(read.values<float>("PointData/velocity"), cloud.columns[0].values);
    EXPECT_EQ(read.values<float>("PointData/radius"), cloud.columns[1].values);
    EXPECT_EQ(read.values<std::int64_t>("PointData/id"), cloud.id);
    EXPECT_EQ(read.values<std::int64_t>("PointData/contacts"), cloud.integers[0].values);
    EXPECT_EQ(read.values<std::uint8_t>("PointData/species"), cloud.species);
    EXPECT_EQ(read.values<double>("FieldData/TimeValue"), std::vector<double>{cloud.time});
    EXPECT_EQ(read.values<std::int64_t>("FieldData/step"), std::vector<std::int64_t>{cloud.step});
}

TEST_F(Vtkhdf, WritesNoParticles)
{
    write_vtkhdf(directory / "a.hdf", line_of(0));
    expect_layout(Reader(directory / "a.hdf"), 0);
}

TEST_F(Vtkhdf, WritesOneParticle)
{
    write_vtkhdf(directory / "a.hdf", line_of(1));
    expect_layout(Reader(directory / "a.hdf"), 1);
}

TEST_F(Vtkhdf, TypeIsAFixedLengthAsciiScalarAndVersionIsOneZero)
{
    write_vtkhdf(directory / "a.hdf", line_of(2));
    const Reader read(directory / "a.hdf");

    const hid_t name = H5Aopen_by_name(read.file, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(name);
    const hid_t space = H5Aget_space(name);
    EXPECT_EQ(H5Tget_class(type), H5T_STRING);
    EXPECT_EQ(H5Tis_variable_str(type), 0);
    EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
    EXPECT_EQ(H5Tget_strpad(type), H5T_STR_NULLPAD);
    EXPECT_EQ(H5Sget_simple_extent_type(space), H5S_SCALAR);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(name, type, text.data());
    EXPECT_EQ(text, "UnstructuredGrid");
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(name);

    const hid_t version = H5Aopen_by_name(read.file, "/VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
    std::array<std::int64_t, 2> numbers{-1, -1};
    H5Aread(version, H5T_NATIVE_INT64, numbers.data());
    EXPECT_EQ(numbers, (std::array<std::int64_t, 2>{1, 0}));
    H5Aclose(version);
}

TEST_F(Vtkhdf, CompressesTheTopologyOnly)
{
    write_vtkhdf(directory / "a.hdf", line_of(1000));
    const Reader read(directory / "a.hdf");
    const auto filters = [&](std::string const& name) {
        const hid_t set = H5Dopen2(read.file, ("/VTKHDF/" + name).c_str(), H5P_DEFAULT);
        const hid_t creation = H5Dget_create_plist(set);
        const int count = H5Pget_nfilters(creation);
        H5Pclose(creation);
        H5Dclose(set);
        return count;
    };
    for (auto* name : {"Connectivity", "Offsets", "Types"}) EXPECT_EQ(filters(name), 2) << name;
    for (auto* name : {"Points", "PointData/velocity", "PointData/id"}) EXPECT_EQ(filters(name), 0) << name;
}

TEST_F(Vtkhdf, LeavesOutIdAndSpeciesThatAreNotGiven)
{
    write_vtkhdf(directory / "a.hdf",
                 {.time = 0, .step = 0, .points = {1, 2, 3}, .columns = {}, .id = {}, .species = {}});
    const Reader read(directory / "a.hdf");
    EXPECT_EQ(H5Lexists(read.file, "/VTKHDF/PointData/id", H5P_DEFAULT), 0);
    EXPECT_EQ(H5Lexists(read.file, "/VTKHDF/PointData/species", H5P_DEFAULT), 0);
}

TEST_F(Vtkhdf, SameCloudGivesSameBytes)
{
    write_vtkhdf(directory / "a.hdf", line_of(100));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // HDF5 stamps whole seconds, if it does
    write_vtkhdf(directory / "b.hdf", line_of(100));
    EXPECT_EQ(content(directory / "a.hdf"), content(directory / "b.hdf"));
}

TEST_F(Vtkhdf, LeavesNoHandleOpenAndNoTemporary)
{
    write_vtkhdf(directory / "a.hdf", line_of(10));
    write_vtkhdf(directory / "a.hdf", line_of(20));
    EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
    EXPECT_EQ(files(), 1u);
    expect_layout(Reader(directory / "a.hdf"), 20);
}

void expect_output_error(fs::path const& file, std::string const& cure)
{
    try {
        write_vtkhdf(file, line_of(3));
        FAIL() << "wrote " << file;
    }
    catch (spate::OutputError const& error) {
        const std::string what = error.what();
        EXPECT_EQ(what.rfind("spate: ", 0), 0u) << what;
        EXPECT_NE(what.find(file.string()), std::string::npos) << what;
        EXPECT_NE(what.find(cure), std::string::npos) << what;
    }
    EXPECT_FALSE(fs::exists(file.string() + ".tmp"));
}

TEST_F(Vtkhdf, MissingDirectoryIsAnOutputError)
{
    expect_output_error(directory / "none" / "a.hdf", "create that directory");
}

TEST_F(Vtkhdf, AFileInPlaceOfTheDirectoryIsAnOutputError)
{
    std::ofstream(directory / "file") << "x";
    expect_output_error(directory / "file" / "a.hdf", "create that directory");
    EXPECT_THROW(SnapshotSeries(directory / "file" / "deeper", "dam"), spate::OutputError);
}

TEST_F(Vtkhdf, UnwritableDirectoryIsAnOutputError)
{
    constexpr uid_t nobody = 65534;
    const uid_t self = ::geteuid();
    fs::permissions(directory, fs::perms(0555));
    if (self == 0 && ::seteuid(nobody) != 0) GTEST_SKIP() << "root may write everywhere";
    expect_output_error(directory / "a.hdf", "in which you may write");
    ASSERT_EQ(::seteuid(self), 0);
    fs::permissions(directory, fs::perms::owner_all);
    EXPECT_EQ(files(), 0u);
}

TEST_F(Vtkhdf, ADirectoryInPlaceOfTheFileIsAnOutputError)
{
    fs::create_directories(directory / "a.hdf" / "inner");
    expect_output_error(directory / "a.hdf", "move what is in the way");
}

TEST_F(Vtkhdf, TheEarlierFileSurvivesAFailedWrite)
{
    write_vtkhdf(directory / "a.hdf", line_of(10));
    const std::string before = content(directory / "a.hdf");
    {
        const small_tank::SmallDisk disk(4096);
        EXPECT_THROW(write_vtkhdf(directory / "a.hdf", line_of(5000)), spate::OutputError);
    }
    EXPECT_EQ(content(directory / "a.hdf"), before);
    EXPECT_EQ(files(), 1u);
    write_vtkhdf(directory / "a.hdf", line_of(5000));
    expect_layout(Reader(directory / "a.hdf"), 5000);
}

TEST_F(Vtkhdf, AStaleTemporaryIsReplaced)
{
    std::ofstream(directory / "a.hdf.tmp") << "left by a crash";
    write_vtkhdf(directory / "a.hdf", line_of(4));
    expect_layout(Reader(directory / "a.hdf"), 4);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Vtkhdf, RefusesAColumnThatDoesNotFit)
{
    const auto refused = [&](auto change) {
        Cloud cloud = line_of(5);
        change(cloud);
        EXPECT_THROW(write_vtkhdf(directory / "a.hdf", cloud), std::invalid_argument);
    };
    refused([](Cloud& c) { c.points.pop_back(); });
    refused([](Cloud& c) { c.columns[0].values.pop_back(); });
    refused([](Cloud& c) { c.columns[0].components = 2; });
    refused([](Cloud& c) { c.columns[0].name = "a/b"; });
    refused([](Cloud& c) { c.columns[0].name = "a.b"; });
    refused([](Cloud& c) { c.columns[0].name = ""; });
    refused([](Cloud& c) { c.columns[0].name = "radius"; });
    refused([](Cloud& c) { c.integers[0].name = "id"; });
    refused([](Cloud& c) { c.id.pop_back(); });
    refused([](Cloud& c) { c.species.push_back(0); });
    refused([](Cloud& c) { c.time = std::numeric_limits<double>::quiet_NaN(); });
    EXPECT_EQ(files(), 0u);
}

TEST_F(Vtkhdf, SeriesNamesEachSnapshotWithItsTime)
{
    SnapshotSeries series(directory / "made", "dam");
    for (const double time : {0.0, 0.1, 1e-7}) {
        Cloud cloud = line_of(3);
        cloud.time = time;
        series.write(cloud);
    }
    EXPECT_EQ(content(directory / "made" / "dam.hdf.series"), "{\"file-series-version\":\"1.0\",\"files\":[\n"
                                                              "{\"name\":\"dam_000000.hdf\",\"time\":0},\n"
                                                              "{\"name\":\"dam_000001.hdf\",\"time\":0.1},\n"
                                                              "{\"name\":\"dam_000002.hdf\",\"time\":1e-07}\n"
                                                              "]}\n");
    EXPECT_EQ(Reader(directory / "made" / "dam_000001.hdf").values<double>("FieldData/TimeValue"), std::vector{0.1});
}

TEST_F(Vtkhdf, SeriesGoesOnAfterARestart)
{
    SnapshotSeries first(directory, "dam");
    first.write(line_of(3));
    SnapshotSeries second(directory, "dam", first.times());
    EXPECT_EQ(second.write(line_of(3)), directory / "dam_000001.hdf");
    EXPECT_NE(content(directory / "dam.hdf.series").find("dam_000000.hdf"), std::string::npos);
}

TEST_F(Vtkhdf, SeriesDoesNotCountAFailedSnapshot)
{
    SnapshotSeries series(directory, "dam");
    series.write(line_of(3));
    const std::string before = content(directory / "dam.hdf.series");
    {
        const small_tank::SmallDisk disk(4096);
        EXPECT_THROW(series.write(line_of(5000)), spate::OutputError);
    }
    EXPECT_EQ(content(directory / "dam.hdf.series"), before);
    EXPECT_EQ(series.write(line_of(3)), directory / "dam_000001.hdf");
    EXPECT_THROW(SnapshotSeries(directory, "a/b"), std::invalid_argument);
}

} // namespace
