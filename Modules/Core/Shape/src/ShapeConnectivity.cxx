#include "voxelcore/Shape/ShapeConnectivity.h"

#include "ContactPlaces.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/GrowingPieces.h"
#include "voxelcore/Shape/PaddedShape.h"
#include "voxelcore/Shape/TouchingPieces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kRoom = PaddedShape::kRoom;

// Of the walk. One step in eight goes anywhere near: with none, one in five random masks of 16^3 voxels at 5 % was
// left, with one in eight none of twenty up to 30 %. A step takes about a microsecond.
constexpr std::size_t   kWander = 8;
constexpr std::uint64_t kLeastSteps = 100000;
constexpr std::uint64_t kStepsOfAPlace = 2000;
constexpr std::uint64_t kMostSteps = 20000000;

/** One of the 48 ways to turn the grid: turned axis k is axis `axis[k]`, backwards where `back[k]`. */
struct GridTurning
{
  std::array<std::size_t, 3> axis{ 0, 1, 2 };
  std::array<bool, 3>        back{ false, false, false };

  Voxel
  operator()(const Voxel & at) const
  {
    Voxel turned;
    for (std::size_t k = 0; k < 3; ++k)
    {
      turned[k] = back[k] ? -at[axis[k]] : at[axis[k]];
    }
    return turned;
  }
};

using Profile = std::vector<std::int64_t>;

/** How many voxels lie in each plane across an axis. */
std::array<Profile, 3>
ProfilesOf(const VoxelShape & shape)
{
  const auto &           size = shape.Box().size;
  std::array<Profile, 3> profiles;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    profiles[axis].resize(static_cast<std::size_t>(size[axis]) + 1);
  }
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const ConstShapeRow row = shape.Row(y, z);
      std::uint64_t       last = 0;
      std::int64_t        count = 0;
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        const std::uint64_t bits = row[word];
        count += std::popcount(bits);
        for (std::uint64_t changes = bits ^ (bits << 1 | last); changes != 0; changes &= changes - 1)
        {
          const auto at = static_cast<unsigned>(std::countr_zero(changes));
          profiles[0][64 * word + at] += (bits >> at & 1U) != 0 ? 1 : -1; // summed up below
        }
        last = bits >> 63;
      }
      profiles[1][static_cast<std::size_t>(y)] += count;
      profiles[2][static_cast<std::size_t>(z)] += count;
    }
  }
  std::partial_sum(profiles[0].begin(), profiles[0].end(), profiles[0].begin());
  for (Profile & profile : profiles)
  {
    profile.pop_back();
  }
  return profiles;
}

/** The turning that the shape's own form picks, so that what is decided by coordinates turns with it: by how many
 *  voxels lie in each plane, then by where the contacts are. What is alike in all of these is symmetric but for the
 *  rarest shapes. */
GridTurning
TurningOf(const VoxelShape & shape, const std::vector<Voxel> & contacts)
{
  const std::array<Profile, 3>          profiles = ProfilesOf(shape);
  std::array<std::array<Profile, 2>, 3> ways; // of each axis: forwards, backwards
  std::array<Profile, 3>                best;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ways[axis] = { profiles[axis], Profile(profiles[axis].rbegin(), profiles[axis].rend()) };
    best[axis] = std::max(ways[axis][0], ways[axis][1]);
  }
  const auto mix = [](std::uint64_t h, std::int64_t value) {
    h = (h ^ static_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
    return h ^ (h >> 32);
  };
  const auto &                                                        size = shape.Box().size;
  std::array<std::size_t, 3>                                          axes{ 0, 1, 2 };
  std::vector<std::pair<std::array<const Profile *, 3>, GridTurning>> turnings;
  do
  {
    if (!ranges::is_sorted(axes, std::greater(), [&](std::size_t axis) -> const Profile & { return best[axis]; }))
    {
      continue;
    }
    for (unsigned backs = 0; backs < 8; ++backs)
    {
      GridTurning turning{ axes, {} };
      bool        isBest = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        turning.back[k] = (backs >> k & 1U) != 0;
        isBest = isBest && ways[axes[k]][turning.back[k] ? 1 : 0] == best[axes[k]];
      }
      if (isBest)
      {
        turnings.push_back({ {}, turning });
      }
    }
  } while (ranges::next_permutation(axes).found);
  if (turnings.size() == 1)
  {
    return turnings.front().second;
  }
  GridTurning   picked;
  std::uint64_t greatest = 0;
  for (const auto & [unused, turning] : turnings)
  {
    std::uint64_t sum = 0;
    for (const Voxel & contact : contacts)
    {
      for (unsigned i = 0; i < 8; ++i)
      {
        Voxel at{ contact[0] - 1 + static_cast<std::int32_t>(i & 1U),
                  contact[1] - 1 + static_cast<std::int32_t>(i >> 1U & 1U),
                  contact[2] - 1 + static_cast<std::int32_t>(i >> 2U & 1U) };
        if (!shape.Contains(at[0] + shape.Box().lower[0], at[1] + shape.Box().lower[1], at[2] + shape.Box().lower[2]))
        {
          continue;
        }
        std::uint64_t name = 1;
        for (std::size_t k = 0; k < 3; ++k)
        {
          const std::size_t axis = turning.axis[k];
          name = mix(name, turning.back[k] ? size[axis] - 1 - at[axis] : at[axis]);
        }
        sum += name;
      }
    }
    if (sum >= greatest)
    {
      greatest = sum;
      picked = turning;
    }
  }
  return picked;
}

/** Whether a voxel, with the room around it counted, lies in a box of this size. */
bool
IsInBox(const Voxel & size, const Voxel & at)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (at[axis] < kRoom || at[axis] >= kRoom + size[axis])
    {
      return false;
    }
  }
  return true;
}

class Connecting
{
public:
  Connecting(const VoxelShape & mask, const std::vector<Voxel> & contacts)
    : m_Shape(mask)
    , m_Size(mask.Box().size)
    , m_Turning(TurningOf(mask, contacts))
  {
    for (const Voxel & contact : contacts)
    {
      const Voxel at = Padded(contact);
      if (!m_Where.contains(at))
      {
        Add(Key(at));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) // the other ends of edges on the box's far sides
      {
        Voxel end = at;
        ++end[axis];
        if (contact[axis] + 1 == m_Size[axis] && IsBad(end) && !m_Where.contains(end))
        {
          Add(Key(end));
        }
      }
    }
  }

  /** Settles what can be settled. */
  void
  Settle(const ProgressCallback & progress);

  /** Takes back changes that the open shape does not need. */
  void
  TakeBack();

  ConnectedShape
  Release(const VoxelBox & box) &&;

private:
  /** A place in turned coordinates, by which places are told apart, and itself. */
  struct Place
  {
    Voxel turned;
    Voxel at;

    friend bool
    operator<(const Place & a, const Place & b)
    {
      return a.turned < b.turned;
    }
    friend bool
    operator==(const Place & a, const Place & b)
    {
      return a.turned == b.turned;
    }
  };

  static Voxel
  Padded(const Voxel & at)
  {
    return { at[0] + kRoom, at[1] + kRoom, at[2] + kRoom };
  }

  /** Of a lattice corner: twice its coordinates less one lie symmetrically between the voxels', as turning needs. */
  Place
  Key(const Voxel & corner) const
  {
    return { m_Turning({ 2 * corner[0] - 1, 2 * corner[1] - 1, 2 * corner[2] - 1 }), corner };
  }

  void
  Add(const Place & bad)
  {
    m_Where[bad.at] = m_Bad.size();
    m_Bad.push_back(bad);
  }

  void
  Remove(const Place & good)
  {
    const auto        where = m_Where.find(good.at);
    const std::size_t at = where->second;
    m_Bad[at] = m_Bad.back();
    m_Where[m_Bad[at].at] = at;
    m_Bad.pop_back();
    m_Where.erase(where);
  }

  bool
  IsBad(const Voxel & corner) const
  {
    unsigned block = 0;
    for (std::int32_t k = 0; k < 2; ++k)
    {
      for (std::int32_t j = 0; j < 2; ++j)
      {
        block |= m_Shape.Bits(corner[0] - 1, corner[1] - 1 + j, corner[2] - 1 + k, 2)
                 << static_cast<unsigned>(4 * k + 2 * j);
      }
    }
    return !kWellComposed[block];
  }

  /** The eight corners of a voxel whose blocks are not well-composed, as bits. */
  unsigned
  BadAround(Neighbourhood around) const
  {
    unsigned bad = 0;
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      const unsigned shift = (corner & 1U) + 3 * (corner >> 1U & 1U) + 9 * (corner >> 2U);
      const auto     cube = around >> shift;
      const unsigned block = (cube & 3U) | (cube >> 3U & 3U) << 2U | (cube >> 9U & 3U) << 4U | (cube >> 12U & 3U) << 6U;
      bad |= kWellComposed[block] ? 0U : 1U << corner;
    }
    return bad;
  }

  /** A flip that leaves the closed union what it is, and what it does to the blocks around its voxel. */
  struct Flip
  {
    int      gain = 0;   ///< by how many blocks fewer are not well-composed
    int      around = 0; ///< voxels in among the 26: the more, the deeper it lies
    bool     isFill = false;
    Place    place;
    unsigned before = 0;
    unsigned after = 0;
  };

  /** Those of the eight voxels around a corner, or of as many more as lie within `reach` of these; the best first. */
  std::vector<Flip>
  FlipsAt(const Voxel & corner, bool removes, std::int32_t reach = 0);

  /** Flips a voxel and notes which corners became bad or good. */
  void
  Do(const Voxel & at);

  /** Makes the fill at a place that betters most, or else two that better together. */
  bool
  StepAt(const Place & place);

  /** Flips voxels at places that are left, the best flip or one like it, now and then any flip near, until nothing is
   *  left, or for so many steps; then it goes back to where least was left (as WalkSAT: Selman, Kautz and Cohen 1994).
   */
  void
  Walk(std::uint64_t steps, const ProgressCallback & progress);

  PaddedShape                  m_Shape;
  Voxel                        m_Size;
  GridTurning                  m_Turning;
  SimpleVoxels                 m_Simple;
  std::vector<Place>           m_Bad;     ///< corners whose blocks are not well-composed
  std::map<Voxel, std::size_t> m_Where;   ///< of each of them, in the list
  std::set<Voxel>              m_Changed; ///< voxels that are not what the mask has
};

std::vector<Connecting::Flip>
Connecting::FlipsAt(const Voxel & corner, bool removes, std::int32_t reach)
{
  std::vector<Flip>  flips;
  const std::int32_t side = 2 + 2 * reach;
  for (std::int32_t i = 0; i < side * side * side; ++i)
  {
    const Voxel at{ corner[0] - 1 - reach + i % side,
                    corner[1] - 1 - reach + i / side % side,
                    corner[2] - 1 - reach + i / (side * side) };
    if (!IsInBox(m_Size, at))
    {
      continue;
    }
    const Neighbourhood around = m_Shape.Around(at);
    const bool          isFill = (around & kCentre27) == 0;
    if ((!isFill && !removes) || !m_Simple.IsSimple(~around & kAll27))
    {
      continue;
    }
    Flip flip;
    flip.before = BadAround(around);
    flip.after = BadAround(around ^ kCentre27);
    flip.gain = std::popcount(flip.before) - std::popcount(flip.after);
    flip.around = std::popcount(around & ~kCentre27);
    flip.isFill = isFill;
    flip.place = { m_Turning(at), at };
    flips.push_back(flip);
  }
  ranges::sort(flips, [](const Flip & a, const Flip & b) {
    return std::tuple(-a.gain, !a.isFill, -a.around, a.place) < std::tuple(-b.gain, !b.isFill, -b.around, b.place);
  });
  return flips;
}

void
Connecting::Do(const Voxel & at)
{
  const Neighbourhood around = m_Shape.Around(at);
  const unsigned      before = BadAround(around);
  const unsigned      after = BadAround(around ^ kCentre27);
  m_Shape.Flip(at);
  if (!m_Changed.insert(at).second)
  {
    m_Changed.erase(at);
  }
  std::vector<std::pair<Place, bool>> changes;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    if (((before ^ after) >> corner & 1U) != 0)
    {
      const Place key = Key({ at[0] + static_cast<std::int32_t>(corner & 1U),
                              at[1] + static_cast<std::int32_t>(corner >> 1U & 1U),
                              at[2] + static_cast<std::int32_t>(corner >> 2U) });
      changes.push_back({ key, (after >> corner & 1U) != 0 });
    }
  }
  ranges::sort(changes); // the list, from which the walk draws, turns with the grid
  for (const auto & [key, isBad] : changes)
  {
    isBad ? Add(key) : Remove(key);
  }
}

bool
Connecting::StepAt(const Place & place)
{
  const std::vector<Flip> flips = FlipsAt(place.at, false);
  if (!flips.empty() && flips.front().gain > 0)
  {
    Do(flips.front().place.at);
    return true;
  }
  for (const Flip & first : flips)
  {
    Do(first.place.at);
    const std::vector<Flip> next = FlipsAt(place.at, false);
    if (!next.empty() && first.gain + next.front().gain > 0)
    {
      Do(next.front().place.at);
      return true;
    }
    Do(first.place.at);
  }
  return false;
}

void
Connecting::Walk(std::uint64_t steps, const ProgressCallback & progress)
{
  std::uint64_t state = 0x9E3779B97F4A7C15U;
  const auto    draw = [&state](std::size_t count) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>((state >> 33U) % count);
  };
  std::vector<Voxel> since; // flips since there were fewest
  std::size_t        fewest = m_Bad.size();
  for (std::uint64_t step = 0; step < steps && !m_Bad.empty(); ++step)
  {
    if (step % 16384 == 0)
    {
      ReportProgress(progress, "", 0.5 + 0.5 * static_cast<double>(step) / static_cast<double>(steps));
    }
    const Place       place = m_Bad[draw(m_Bad.size())];
    const bool        wanders = draw(kWander) == 0;
    std::vector<Flip> flips = FlipsAt(place.at, true, wanders ? 1 : 0);
    if (flips.empty())
    {
      flips = FlipsAt(place.at, true, 1);
    }
    if (flips.empty())
    {
      continue;
    }
    std::size_t pick = 0;
    if (wanders)
    {
      pick = draw(flips.size());
    }
    else
    {
      std::size_t alike = 1;
      while (alike < flips.size() && flips[alike].gain == flips[0].gain)
      {
        ++alike;
      }
      pick = draw(alike);
    }
    Do(flips[pick].place.at);
    since.push_back(flips[pick].place.at);
    if (m_Bad.size() < fewest)
    {
      fewest = m_Bad.size();
      since.clear();
    }
  }
  for (std::size_t i = since.size(); i-- > 0;)
  {
    Do(since[i]);
  }
}

void
Connecting::Settle(const ProgressCallback & progress)
{
  for (bool moves = true; moves;)
  {
    moves = false;
    std::vector<Place> places = m_Bad;
    std::sort(places.begin(), places.end());
    for (const Place & place : places)
    {
      moves = (IsBad(place.at) && StepAt(place)) || moves;
    }
    ReportProgress(progress, "", 0.5);
  }
  std::sort(m_Bad.begin(), m_Bad.end());
  for (std::size_t i = 0; i < m_Bad.size(); ++i)
  {
    m_Where[m_Bad[i].at] = i;
  }
  Walk(std::min(kMostSteps, m_Bad.empty() ? 0 : kLeastSteps + kStepsOfAPlace * m_Bad.size()), progress);
}

void
Connecting::TakeBack()
{
  std::vector<std::pair<int, Place>> changed;
  for (const Voxel & at : m_Changed)
  {
    changed.push_back({ std::popcount(m_Shape.Around(at)), { m_Turning(at), at } });
  }
  for (bool moves = true; moves;)
  {
    moves = false;
    ranges::sort(changed);
    std::erase_if(changed, [&](const auto & item) {
      const Voxel & at = item.second.at;
      if (!m_Simple.IsSimple(m_Shape.Around(at)))
      {
        return false;
      }
      m_Shape.Flip(at);
      m_Changed.erase(at);
      moves = true;
      return true;
    });
  }
}

ConnectedShape
Connecting::Release(const VoxelBox & box) &&
{
  ConnectedShape result;
  for (const Voxel & at : m_Changed)
  {
    ++(m_Shape.Contains(at) ? result.voxelsAdded : result.voxelsRemoved);
  }
  for (const Place & place : m_Bad)
  {
    Voxel corner = place.at;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      corner[axis] += box.lower[axis] - kRoom;
    }
    result.left.push_back(corner);
  }
  ranges::sort(result.left, {}, [](const Voxel & at) { return Voxel{ at[2], at[1], at[0] }; });
  result.shape = std::move(m_Shape).Release();
  return result;
}

/** Pieces that touch, joined one by one. */
class Joining
{
public:
  Joining(const VoxelShape & mask, const std::vector<Voxel> & contacts, std::int64_t least)
    : m_Shape(mask)
    , m_Pieces(mask)
    , m_Touching(m_Pieces.Touching())
    , m_Size(mask.Box().size)
    , m_Turning(TurningOf(mask, contacts))
    , m_Contacts(contacts)
    , m_Least(least)
  {
    for (Voxel & contact : m_Contacts)
    {
      contact = { contact[0] + kRoom, contact[1] + kRoom, contact[2] + kRoom };
    }
  }

  JoinedPieces
  Run(const VoxelBox & box) &&
  {
    while (JoinBest(Singles()) || JoinBest(Pairs()))
    {}
    for (JoinedPieces::Joint & joint : m_Joints)
    {
      for (Voxel & at : joint.voxels)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          at[axis] += box.lower[axis] - kRoom;
        }
      }
    }
    const auto apart = static_cast<std::uint64_t>(m_Pieces.Count()) - m_Touching.Count();
    return { std::move(m_Shape).Release(), std::move(m_Joints), apart };
  }

private:
  /** One fill or two that join; the best come first: those that join most and lie deepest. Of dust there are millions,
   *  so that no heap is asked for them. */
  struct Joint
  {
    int                  joined = 0;
    int                  around = 0; ///< voxels in among the 26
    bool                 isPair = false;
    std::array<Voxel, 2> turned{};
    std::array<Voxel, 2> voxels{};
  };

  /** Whether pieces, by one run of each, touch in the mask, or are held together by others that do. */
  bool
  Touch(const std::vector<std::uint32_t> & pieces)
  {
    return ranges::all_of(pieces,
                          [&](std::uint32_t one) { return m_Touching.Find(one) == m_Touching.Find(pieces.front()); });
  }

  /** How many pieces a voxel put in makes one; 0 where it makes none one, or changes anything else. */
  int
  PiecesAt(const Voxel & at)
  {
    const Neighbourhood around = m_Shape.Around(at);
    if ((around & kCentre27) != 0 || !IsInBox(m_Size, at))
    {
      return 0;
    }
    const Pieces pieces = ShapePieces(around);
    if (pieces.count < 2 || BackgroundPieces(around).count != 1 ||
        m_Pieces.Count() - static_cast<std::int64_t>(pieces.count) + 1 < m_Least)
    {
      return 0;
    }
    const auto apart = m_Pieces.Apart(at, pieces);
    return apart && Touch(*apart) ? static_cast<int>(pieces.count) : 0;
  }

  /** Whether a voxel put in changes nothing. */
  bool
  CanGoFirst(const Voxel & at) const
  {
    return !m_Shape.Contains(at) && IsInBox(m_Size, at) && IsSimpleVoxel(m_Shape.Around(at));
  }

  void
  Fill(const Voxel & at)
  {
    const auto pieces = m_Pieces.Apart(at, ShapePieces(m_Shape.Around(at)));
    m_Shape.Flip(at);
    m_Pieces.Join(at, *pieces);
  }

  static std::array<Voxel, 8>
  Block(const Voxel & corner)
  {
    std::array<Voxel, 8> block;
    for (std::int32_t i = 0; i < 8; ++i)
    {
      block[static_cast<std::size_t>(i)] = { corner[0] - 1 + (i & 1),
                                             corner[1] - 1 + (i >> 1 & 1),
                                             corner[2] - 1 + (i >> 2) };
    }
    return block;
  }

  /** Forgets contacts of one piece with itself. */
  void
  KeepContactsOfTwo()
  {
    std::erase_if(m_Contacts, [&](const Voxel & contact) {
      std::set<std::uint32_t> pieces;
      for (const Voxel & at : Block(contact))
      {
        if (m_Shape.Contains(at))
        {
          pieces.insert(m_Pieces.Of(at));
        }
      }
      return pieces.size() < 2;
    });
  }

  std::vector<Joint>
  Singles()
  {
    KeepContactsOfTwo();
    std::vector<Joint> joints;
    for (const Voxel & contact : m_Contacts)
    {
      for (const Voxel & at : Block(contact))
      {
        if (const int joined = PiecesAt(at); joined > 0)
        {
          joints.push_back({ joined, std::popcount(m_Shape.Around(at)), false, { m_Turning(at) }, { at } });
        }
      }
    }
    return joints;
  }

  /** The first of the two is simple, and so it alters nothing by itself. */
  std::vector<Joint>
  Pairs()
  {
    std::vector<Joint> joints;
    for (const Voxel & contact : m_Contacts)
    {
      for (const Voxel & first : Block(contact))
      {
        if (!CanGoFirst(first))
        {
          continue;
        }
        Fill(first);
        for (const Voxel & second : Block(contact))
        {
          if (const int joined = PiecesAt(second); joined > 0)
          {
            joints.push_back({ joined,
                               std::popcount(m_Shape.Around(first)) + std::popcount(m_Shape.Around(second)),
                               true,
                               { m_Turning(first), m_Turning(second) },
                               { first, second } });
          }
        }
        m_Shape.Flip(first);
        m_Pieces.Forget(first);
      }
    }
    return joints;
  }

  /** Makes them in their order where they still join. */
  bool
  JoinBest(std::vector<Joint> joints)
  {
    ranges::sort(joints, [](const Joint & a, const Joint & b) {
      return std::tie(b.joined, b.around, a.turned) < std::tie(a.joined, a.around, b.turned);
    });
    bool moves = false;
    for (const Joint & joint : joints)
    {
      const auto [first, second] = joint.voxels;
      const bool    isPair = joint.isPair;
      const Voxel & last = isPair ? second : first;
      if (isPair && !CanGoFirst(first))
      {
        continue;
      }
      if (isPair)
      {
        Fill(first);
      }
      if (const int pieces = PiecesAt(last); pieces > 0)
      {
        Fill(last);
        m_Joints.push_back({ pieces, isPair ? std::vector{ first, second } : std::vector{ first } });
        moves = true;
      }
      else if (isPair)
      {
        m_Shape.Flip(first);
        m_Pieces.Forget(first);
      }
    }
    return moves;
  }

  PaddedShape        m_Shape;
  GrowingPieces      m_Pieces;
  UnionFind          m_Touching; ///< its runs, of the mask
  Voxel              m_Size;     ///< of the mask's box
  GridTurning        m_Turning;
  std::vector<Voxel> m_Contacts; ///< corners
  std::int64_t       m_Least;

  std::vector<JoinedPieces::Joint> m_Joints;
};

} // namespace

std::string_view
ConnectivityName(Connectivity connectivity)
{
  return connectivity == Connectivity::Six ? "6" : connectivity == Connectivity::TwentySix ? "26" : "joined";
}

std::optional<Connectivity>
ConnectivityNamed(std::string_view name)
{
  for (const Connectivity one : { Connectivity::Six, Connectivity::TwentySix, Connectivity::Joined })
  {
    if (ConnectivityName(one) == name)
    {
      return one;
    }
  }
  return std::nullopt;
}

Connectivity
RequireConnectivity(std::string_view name)
{
  const auto connectivity = ConnectivityNamed(name);
  if (!connectivity)
  {
    throw UsageError("--connectivity: '" + std::string(name) + "' is none; give 6, 26 or joined");
  }
  return *connectivity;
}

ConnectedShape
ConnectOverCorners(const VoxelShape & shape, const ProgressCallback & progress)
{
  const VoxelShape         mask = CropToVoxels(shape);
  const std::vector<Voxel> contacts = FindContacts(mask);
  if (contacts.empty())
  {
    return { mask, 0, 0, {} };
  }
  Connecting connecting(mask, contacts);
  connecting.Settle(progress);
  connecting.TakeBack();
  return std::move(connecting).Release(mask.Box());
}

JoinedPieces
JoinTouchingPieces(const VoxelShape & shape, std::int64_t least)
{
  const VoxelShape         mask = CropToVoxels(shape);
  const std::vector<Voxel> contacts = FindContacts(mask);
  if (contacts.empty())
  {
    return { mask, {}, 0 };
  }
  return Joining(mask, contacts, least).Run(mask.Box());
}

} // namespace voxelcore
