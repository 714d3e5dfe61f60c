#include "resources/tile_bins.h"
#include "device/work_group.h"

#include <algorithm>
#include <numeric>

#include "resources/bin_bounds.h"

namespace wrinkle {

namespace {

constexpr std::uint32_t kEntriesOfTile = 128;  // room for lists, on average; beyond it tiles share their parents' lists
constexpr std::uint32_t kMostEntries = 1u << 28;
constexpr std::size_t kGroup = 64;

std::uint32_t supers_of(std::uint32_t pixels, std::uint32_t size) { return (pixels + size - 1) / size; }

template <class T>
cl::Buffer read_only(const Device& device, const std::vector<T>& values) {
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T),
            const_cast<T*>(values.data())};
}

/// Enqueues a kernel over `items` after `wait`, which becomes the event of its end.
void launch(const Device& device, const cl::Kernel& kernel, std::size_t items, std::size_t group,
            std::vector<cl::Event>& wait) {
    cl::Event done;
    group = work_group(device, kernel, group);
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange((items + group - 1) / group * group),
                                      cl::NDRange(group), &wait, &done);
    wait = {done};
}

template <class... Arguments>
void set(cl::Kernel& kernel, cl_uint first, const Arguments&... arguments) {
    (kernel.setArg(first++, arguments), ...);
}

}  // namespace

TileBins::TileBins(const Device& device, const cl::Program& program, std::size_t rows, int lanes)
    : device_(device),
      rows_(static_cast<std::uint32_t>(rows)),
      group_(lanes == 1 ? 32 : 1),  // a CPU does 16 tiles at a time within a work-item
      tiles_kernel_(program, "wr_bin_tiles"),
      parents_kernel_(program, "wr_bin_parents"),
      supers_kernel_(program, "wr_bin_supers"),
      lists_kernel_(program, "wr_bin_lists"),
      used_(device.context, CL_MEM_READ_WRITE, sizeof(cl_uint)) {
    numbers_.resize(rows_);
    std::iota(numbers_.begin(), numbers_.end(), 0u);
}

void TileBins::set_camera(const BinBounds& bounds, cl::Buffer table, bool fp64) {
    table_ = std::move(table);
    boxes_ = read_only(device_, bounds.boxes);
    bounds_ = read_only(device_, bounds.bounds);
    groups_ = read_only(device_, bounds.groups);
    std::vector<double> wide;
    for (const Imath::V3d& axis : bounds.axes) wide.insert(wide.end(), {axis.x, axis.y, axis.z});
    axes_ = fp64 ? read_only(device_, wide) : read_only(device_, std::vector<float>(wide.begin(), wide.end()));
    table_bytes_ = table_.getInfo<CL_MEM_SIZE>() +
                   sizeof(float) * (bounds.boxes.size() + bounds.bounds.size() + bounds.groups.size());
}

void TileBins::make_room(std::uint32_t supers) {
    if (supers <= rooms_for_) return;
    rooms_for_ = supers;
    const std::uint64_t tiles = std::uint64_t{supers} * WR_TILES_OF_SUPER;
    const std::uint64_t lists = limit_ > 0 ? limit_ : std::uint64_t{kEntriesOfTile} * tiles + 4 * std::uint64_t{rows_};
    capacity_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(rows_ + lists, kMostEntries));
    room_bytes_ = capacity_ * (sizeof(cl_uint) + sizeof(cl_ushort));
    entries_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, capacity_ * sizeof(cl_uint));
    hits_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, capacity_ * sizeof(cl_ushort));
    for (std::size_t level = 0; level < 3; ++level) {
        const std::size_t count = tiles >> (4 * level);
        tile_bounds_[level] = cl::Buffer(device_.context, CL_MEM_READ_WRITE, count * 6 * sizeof(float));
        lists_[level] = cl::Buffer(device_.context, CL_MEM_READ_WRITE, count * WR_LIST_WORDS * sizeof(cl_uint));
        room_bytes_ += count * (6 * sizeof(float) + WR_LIST_WORDS * sizeof(cl_uint));
    }
    device_.queue.enqueueWriteBuffer(entries_, CL_TRUE, 0, rows_ * sizeof(cl_uint), numbers_.data());
}

cl::Event TileBins::enqueue(const cl::Buffer& frame, const cl::Buffer& numbers, const std::vector<cl::Buffer>& in,
                            const Rows& rows, std::uint32_t width, std::uint32_t in_first, std::uint32_t in_pixels,
                            const std::vector<cl::Event>& wait) {
    supers_a_row_ = supers_of(width, WR_SUPER_WIDTH);
    supers_ = supers_a_row_ * supers_of(rows.count, WR_SUPER_HEIGHT);
    make_room(supers_);
    const cl_uint tiles = supers_ * WR_TILES_OF_SUPER, blocks = tiles / 16;
    std::vector<cl::Event> after = wait;
    after.insert(after.end(), last_use_.begin(), last_use_.end());

    cl::Event cleared;
    device_.queue.enqueueFillBuffer(used_, cl_uint{rows_}, 0, sizeof(cl_uint), &after, &cleared);
    after = {cleared};
    set(tiles_kernel_, 0, frame, numbers, axes_, tile_bounds_[0], tiles, cl_uint{supers_a_row_});
    cl_uint next = 6;
    for (const cl::Buffer& plane : in) tiles_kernel_.setArg(next++, plane);
    set(tiles_kernel_, next, cl_uint{in_first}, cl_uint{in_pixels}, cl_uint{rows.first}, cl_uint{width},
        cl_uint{rows.count});
    launch(device_, tiles_kernel_, tiles, kGroup, after);
    set(parents_kernel_, 0, tile_bounds_[0], tile_bounds_[1], blocks);
    launch(device_, parents_kernel_, blocks, kGroup, after);
    set(parents_kernel_, 0, tile_bounds_[1], tile_bounds_[2], cl_uint{supers_});
    launch(device_, parents_kernel_, supers_, kGroup, after);
    for (cl::Kernel* kernel : {&supers_kernel_, &lists_kernel_})
        set(*kernel, 0, boxes_, bounds_, groups_, cl_uint{rows_}, entries_, cl_uint{capacity_}, used_);
    set(supers_kernel_, 7, tile_bounds_[2], cl_uint{supers_}, lists_[2]);
    launch(device_, supers_kernel_, supers_, group_, after);
    set(lists_kernel_, 7, tile_bounds_[1], cl_uint{supers_}, lists_[2], lists_[1], hits_);
    launch(device_, lists_kernel_, supers_, group_, after);
    set(lists_kernel_, 7, tile_bounds_[0], blocks, lists_[1], lists_[0], hits_);
    launch(device_, lists_kernel_, blocks, group_, after);
    made_ = after;
    return after.front();
}

void TileBins::set_arguments(cl::Kernel& kernel, cl_uint& next) const {
    kernel.setArg(next++, table_);
    kernel.setArg(next++, lists_[0]);
    kernel.setArg(next++, entries_);
    kernel.setArg(next++, cl_uint{supers_a_row_});
}

BinReport TileBins::read(std::uint32_t width, std::uint32_t rows,
                         std::vector<std::vector<std::uint32_t>>* lists) const {
    std::vector<cl_uint> words(std::size_t{supers_} * WR_TILES_OF_SUPER * WR_LIST_WORDS), entries(capacity_);
    device_.queue.enqueueReadBuffer(lists_[0], CL_TRUE, 0, words.size() * sizeof(cl_uint), words.data(), &made_);
    if (lists)
        device_.queue.enqueueReadBuffer(entries_, CL_TRUE, 0, entries.size() * sizeof(cl_uint), entries.data(), &made_);
    BinReport report;
    report.rows = rows_;
    report.bytes = table_bytes_ + room_bytes_;
    for (std::uint32_t y = 0; y < (rows + WR_TILE_HEIGHT - 1) / WR_TILE_HEIGHT; ++y)
        for (std::uint32_t x = 0; x < (width + WR_TILE_WIDTH - 1) / WR_TILE_WIDTH; ++x) {
            const cl_uint* list = words.data() + WR_LIST_WORDS * std::size_t{WR_TILE_NUMBER(x, y, supers_a_row_)};
            ++report.tiles;
            const cl_uint count = list[WR_LIST_COUNT];
            report.touched += count > 0 ? 1 : 0;
            report.inherited += list[WR_LIST_OWN] == 0 ? 1 : 0;
            report.entries += count;
            report.longest = std::max(report.longest, count);
            const auto first = entries.begin() + list[WR_LIST_FIRST];
            if (lists) lists->emplace_back(first, first + count);
        }
    return report;
}

}  // namespace wrinkle
