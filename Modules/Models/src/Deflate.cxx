#include "Deflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{
namespace
{

// RFC 1951, section 3.2
constexpr std::uint32_t kLongestMatch = 258;
constexpr std::uint32_t kFarthest = 32768;
constexpr std::size_t   kEndOfBlock = 256;
constexpr std::size_t   kLiterals = 286; // and lengths
constexpr std::size_t   kDistances = 30;
constexpr std::size_t   kLongestStored = 65535;

// Ours, measured on cores, whose numbers are 4 or 8 bytes wide: files as small as by zlib's fastest level, in half the
// time. Matches are looked for by four bytes, and of three where the number before has them in the same places, as with
// counts that ascend.
constexpr std::uint32_t kNumber = 4;
constexpr int           kHashBits = 15;
constexpr int           kPatience = 8;   ///< literals without a match until steps grow, as a power of two
constexpr std::size_t   kTokens = 32768; ///< literals and matches of a block, which has codes of its own

/** Codes for numbers in steps that double: the first number of each, and how many further bits say the rest. */
template <std::size_t Codes>
struct Steps
{
  std::array<std::uint16_t, Codes> first{};
  std::array<std::uint8_t, Codes>  bits{};
};

constexpr Steps<29> kLengthSteps = [] {
  Steps<29>     steps;
  std::uint16_t length = 3;
  for (std::size_t code = 0; code < 28; ++code)
  {
    steps.first[code] = length;
    steps.bits[code] = static_cast<std::uint8_t>(code < 8 ? 0 : code / 4 - 1);
    length = static_cast<std::uint16_t>(length + (1U << steps.bits[code]));
  }
  steps.first[28] = kLongestMatch;
  return steps;
}();

constexpr Steps<kDistances> kDistanceSteps = [] {
  Steps<kDistances> steps;
  std::uint32_t     distance = 1;
  for (std::size_t code = 0; code < kDistances; ++code)
  {
    steps.first[code] = static_cast<std::uint16_t>(distance);
    steps.bits[code] = static_cast<std::uint8_t>(code < 4 ? 0 : code / 2 - 1);
    distance += 1U << steps.bits[code];
  }
  return steps;
}();

constexpr std::array<std::uint8_t, kLongestMatch + 1> kLengthCode = [] {
  std::array<std::uint8_t, kLongestMatch + 1> codes{};
  for (std::size_t length = 3, code = 0; length <= kLongestMatch; ++length)
  {
    code += code < 28 && length >= kLengthSteps.first[code + 1] ? 1 : 0;
    codes[length] = static_cast<std::uint8_t>(code);
  }
  return codes;
}();

std::size_t
DistanceCode(std::uint32_t distance)
{
  const std::uint32_t from0 = distance - 1;
  if (from0 < 4)
  {
    return from0;
  }
  const auto width = static_cast<std::uint32_t>(std::bit_width(from0));
  return 2 * (width - 1) + ((from0 >> (width - 2)) & 1U);
}

/** Of a symbol: its bits, the first lowest, and how many. */
struct Code
{
  std::uint16_t bits = 0;
  std::uint8_t  length = 0;
};

/** Lengths of a prefix code: Huffman's, from halved frequencies until none is longer than `longest`. Where fewer than
 *  two symbols occur, the first ones get one bit, as some readers want a whole code. */
void
FindLengths(std::span<const std::uint32_t> frequencies, std::uint8_t longest, std::span<Code> codes)
{
  struct Node
  {
    std::uint64_t weight;
    std::uint32_t parent;
  };
  std::vector<std::uint32_t> symbols;
  for (std::uint32_t symbol = 0; symbol < frequencies.size(); ++symbol)
  {
    codes[symbol] = {};
    if (frequencies[symbol] > 0)
    {
      symbols.push_back(symbol);
    }
  }
  for (std::uint32_t symbol = 0; symbols.size() < 2; ++symbol)
  {
    if (frequencies[symbol] == 0)
    {
      symbols.push_back(symbol);
    }
  }
  const auto count = static_cast<std::uint32_t>(symbols.size());
  for (int halvings = 0;; ++halvings)
  {
    const auto weight = [&](std::uint32_t symbol) { return (std::uint64_t{ frequencies[symbol] } >> halvings) + 1; };
    std::sort(symbols.begin(), symbols.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(weight(a), a) < std::pair(weight(b), b);
    });
    std::vector<Node> nodes;
    nodes.reserve(2 * count);
    for (const std::uint32_t symbol : symbols)
    {
      nodes.push_back({ weight(symbol), 0 });
    }
    // Leaves and inner nodes are two queues, each in ascending order.
    std::uint32_t leaf = 0;
    std::uint32_t inner = count;
    const auto    takeLeast = [&] {
      return leaf < count && (inner == nodes.size() || nodes[leaf].weight <= nodes[inner].weight) ? leaf++ : inner++;
    };
    while (nodes.size() < 2 * count - 1)
    {
      const std::uint32_t a = takeLeast();
      const std::uint32_t b = takeLeast();
      const auto          parent = static_cast<std::uint32_t>(nodes.size());
      nodes[a].parent = nodes[b].parent = parent;
      nodes.push_back({ nodes[a].weight + nodes[b].weight, 0 });
    }
    std::vector<std::uint32_t> depth(nodes.size(), 0);
    for (std::size_t node = nodes.size() - 1; node-- > 0;)
    {
      depth[node] = depth[nodes[node].parent] + 1;
    }
    if (*std::max_element(depth.begin(), depth.begin() + count) <= longest)
    {
      for (std::uint32_t i = 0; i < count; ++i)
      {
        codes[symbols[i]].length = static_cast<std::uint8_t>(depth[i]);
      }
      return;
    }
  }
}

/** RFC 1951, section 3.2.2. */
void
FindBits(std::span<Code> codes)
{
  std::array<std::uint32_t, 17> next{};
  for (const Code & code : codes)
  {
    next[code.length + 1U] += code.length > 0 ? 1 : 0;
  }
  for (std::size_t length = 1; length < next.size(); ++length)
  {
    next[length] += next[length - 1];
    next[length] <<= 1U;
  }
  for (Code & code : codes)
  {
    std::uint32_t bits = code.length > 0 ? next[code.length]++ : 0;
    code.bits = 0;
    for (int i = 0; i < code.length; ++i, bits >>= 1U)
    {
      code.bits = static_cast<std::uint16_t>((code.bits << 1U) | (bits & 1U));
    }
  }
}

/** A run of literal bytes, then a match (but at the end). */
struct Token
{
  std::uint32_t from;
  std::uint32_t literals;
  std::uint32_t length;
  std::uint32_t distance;
};

std::uint32_t
FourBytes(const char * at)
{
  const auto * const bytes = reinterpret_cast<const unsigned char *>(at);
  return bytes[0] | (std::uint32_t{ bytes[1] } << 8U) | (std::uint32_t{ bytes[2] } << 16U) |
         (std::uint32_t{ bytes[3] } << 24U);
}

class Packer
{
public:
  explicit Packer(std::string_view bytes)
    : m_Bytes(bytes)
  {
    m_Out.reserve(bytes.size() / 2 + 64);
    m_Out += '\x78'; // RFC 1950: deflate, a window of 32 KB
    m_Out += '\x01';
  }

  std::string
  Take()
  {
    const auto                 size = static_cast<std::uint32_t>(m_Bytes.size());
    std::vector<std::uint32_t> last(std::size_t{ 1 } << kHashBits, 0); // where these four bytes were last, + 1
    std::uint32_t              literalsFrom = 0;
    std::uint32_t              distance = 1;
    std::uint32_t              at = 0;
    while (at + kNumber <= size)
    {
      const std::uint32_t four = FourBytes(m_Bytes.data() + at);
      std::uint32_t &     place = last[(four * 0x9E3779B1U) >> (32 - kHashBits)];
      std::uint32_t       length = 0;
      // Where numbers resemble those before them, the distance is often that of the last match.
      if (distance <= at && FourBytes(m_Bytes.data() + at - distance) == four)
      {
        length = MatchLength(at, distance);
      }
      if (place > 0 && at - (place - 1) <= kFarthest && at - (place - 1) != distance &&
          FourBytes(m_Bytes.data() + place - 1) == four)
      {
        const std::uint32_t other = at - (place - 1);
        const std::uint32_t otherLength = MatchLength(at, other);
        if (otherLength > length + (length > 0 ? 1 : 0))
        {
          length = otherLength;
          distance = other;
        }
      }
      place = at + 1;
      if (length == 0 && kNumber <= at && ((FourBytes(m_Bytes.data() + at - kNumber) ^ four) & 0xFFFFFFU) == 0)
      {
        length = 3;
        distance = kNumber;
      }
      if (length == 0)
      {
        at += 1 + ((at - literalsFrom) >> kPatience);
        continue;
      }
      Add({ literalsFrom, at - literalsFrom, length, distance });
      // Every position of what was matched, but not all of a long run.
      const std::uint32_t end = at + length;
      for (std::uint32_t within = at + 1; within < end && within + kNumber <= size; within += 1 + (length >> 5U))
      {
        last[(FourBytes(m_Bytes.data() + within) * 0x9E3779B1U) >> (32 - kHashBits)] = within + 1;
      }
      at = end;
      literalsFrom = at;
    }
    Add({ literalsFrom, size - literalsFrom, 0, 0 });
    WriteBlock(true);
    Flush();
    const auto adler = adler32_z(1, reinterpret_cast<const Bytef *>(m_Bytes.data()), m_Bytes.size());
    for (unsigned shift = 32; shift > 0; shift -= 8)
    {
      m_Out += static_cast<char>((adler >> (shift - 8)) & 255U);
    }
    return std::move(m_Out);
  }

private:
  std::uint32_t
  MatchLength(std::uint32_t at, std::uint32_t distance) const
  {
    const auto         most = std::min<std::uint32_t>(kLongestMatch, static_cast<std::uint32_t>(m_Bytes.size()) - at);
    const char * const here = m_Bytes.data() + at;
    std::uint32_t      length = kNumber;
    while (length < most && here[length] == (here - distance)[length])
    {
      ++length;
    }
    return length;
  }

  void
  Add(Token token)
  {
    for (std::uint32_t i = 0; i < token.literals; ++i)
    {
      ++m_LiteralCounts[static_cast<unsigned char>(m_Bytes[token.from + i])];
    }
    if (token.length > 0)
    {
      ++m_LiteralCounts[kEndOfBlock + 1 + kLengthCode[token.length]];
      ++m_DistanceCounts[DistanceCode(token.distance)];
    }
    m_Symbols += token.literals + 1;
    m_Tokens.push_back(token);
    if (m_Symbols >= kTokens)
    {
      WriteBlock(false);
    }
  }

  /** At most 16 bits; whole words go out at once. */
  void
  Put(std::uint32_t bits, unsigned count)
  {
    m_Held |= std::uint64_t{ bits } << m_HeldBits;
    m_HeldBits += count;
    if (m_HeldBits >= 32)
    {
      const std::array<char, 4> word{ static_cast<char>(m_Held & 255U),
                                      static_cast<char>((m_Held >> 8U) & 255U),
                                      static_cast<char>((m_Held >> 16U) & 255U),
                                      static_cast<char>((m_Held >> 24U) & 255U) };
      m_Out.append(word.data(), word.size());
      m_Held >>= 32U;
      m_HeldBits -= 32;
    }
  }

  void
  Put(const Code & code)
  {
    Put(code.bits, code.length);
  }

  /** What is held, up to whole bytes. */
  void
  Flush()
  {
    for (; m_HeldBits > 0; m_HeldBits -= std::min(m_HeldBits, 8U))
    {
      m_Out += static_cast<char>(m_Held & 255U);
      m_Held >>= 8U;
    }
  }

  /** The tokens gathered, as what is shorter: with codes of their own, or as they are. */
  void
  WriteBlock(bool isLast)
  {
    ++m_LiteralCounts[kEndOfBlock];
    std::array<Code, kLiterals + kDistances> codes;
    const std::span<Code>                    literals(codes.data(), kLiterals);
    const std::span<Code>                    distances(codes.data() + kLiterals, kDistances);
    FindLengths(m_LiteralCounts, 15, literals);
    FindLengths(m_DistanceCounts, 15, distances);
    FindBits(literals);
    FindBits(distances);

    // RFC 1951, section 3.2.7: the lengths in turn, runs of equal ones shortened.
    struct Run
    {
      std::uint8_t symbol;
      std::uint8_t more;
      std::uint8_t bits;
    };
    std::vector<Run>              runs;
    std::array<std::uint32_t, 19> runCounts{};
    const auto                    add = [&](std::uint8_t symbol, std::size_t more, std::uint8_t bits) {
      runs.push_back({ symbol, static_cast<std::uint8_t>(more), bits });
      ++runCounts[symbol];
    };
    for (std::size_t i = 0; i < codes.size();)
    {
      std::size_t end = i + 1;
      while (end < codes.size() && codes[end].length == codes[i].length)
      {
        ++end;
      }
      const std::uint8_t length = codes[i].length;
      if (length > 0)
      {
        add(length, 0, 0);
        ++i;
      }
      for (; end - i >= 3;)
      {
        const std::size_t most = length > 0 ? 6 : 138;
        const std::size_t count = std::min(end - i, most);
        length > 0 ? add(16, count - 3, 2) : count <= 10 ? add(17, count - 3, 3) : add(18, count - 11, 7);
        i += count;
      }
      for (; i < end; ++i)
      {
        add(length, 0, 0);
      }
    }
    std::array<Code, 19> runCodes;
    FindLengths(runCounts, 7, runCodes);
    FindBits(runCodes);

    constexpr std::array<std::uint8_t, 19> order{ 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    std::uint64_t                          bits = 3 + 5 + 5 + 4 + 3 * order.size();
    for (const Run & run : runs)
    {
      bits += runCodes[run.symbol].length + run.bits;
    }
    for (std::size_t symbol = 0; symbol < kLiterals; ++symbol)
    {
      const unsigned further = symbol > kEndOfBlock ? kLengthSteps.bits[symbol - kEndOfBlock - 1] : 0;
      bits += std::uint64_t{ m_LiteralCounts[symbol] } * (literals[symbol].length + further);
    }
    for (std::size_t symbol = 0; symbol < kDistances; ++symbol)
    {
      bits += std::uint64_t{ m_DistanceCounts[symbol] } * (distances[symbol].length + kDistanceSteps.bits[symbol]);
    }
    const std::uint32_t begin = m_Tokens.front().from;
    const std::uint32_t end = m_Tokens.back().from + m_Tokens.back().literals + m_Tokens.back().length;
    const std::uint64_t stored = std::uint64_t{ end - begin } + 5 * ((end - begin) / kLongestStored + 1);
    if (stored <= bits / 8)
    {
      WriteStored(m_Bytes.substr(begin, end - begin), isLast);
    }
    else
    {
      Put(isLast ? 1 : 0, 1);
      Put(2, 2);
      Put(kLiterals - 257, 5);
      Put(kDistances - 1, 5);
      Put(static_cast<std::uint32_t>(order.size() - 4), 4);
      for (const std::uint8_t symbol : order)
      {
        Put(runCodes[symbol].length, 3);
      }
      for (const Run & run : runs)
      {
        Put(runCodes[run.symbol]);
        Put(run.more, run.bits);
      }
      WriteTokens(literals, distances);
      Put(literals[kEndOfBlock]);
    }
    m_Tokens.clear();
    m_Symbols = 0;
    m_LiteralCounts = {};
    m_DistanceCounts = {};
  }

  void
  WriteTokens(std::span<const Code> literals, std::span<const Code> distances)
  {
    for (const Token & token : m_Tokens)
    {
      for (std::uint32_t i = 0; i < token.literals; ++i)
      {
        Put(literals[static_cast<unsigned char>(m_Bytes[token.from + i])]);
      }
      if (token.length > 0)
      {
        const std::size_t lengthCode = kLengthCode[token.length];
        const std::size_t distanceCode = DistanceCode(token.distance);
        Put(literals[kEndOfBlock + 1 + lengthCode]);
        Put(token.length - kLengthSteps.first[lengthCode], kLengthSteps.bits[lengthCode]);
        Put(distances[distanceCode]);
        Put(token.distance - kDistanceSteps.first[distanceCode], kDistanceSteps.bits[distanceCode]);
      }
    }
  }

  void
  WriteStored(std::string_view bytes, bool isLast)
  {
    do
    {
      const std::string_view part = bytes.substr(0, kLongestStored);
      bytes.remove_prefix(part.size());
      Put(isLast && bytes.empty() ? 1 : 0, 3);
      Flush();
      Put(static_cast<std::uint32_t>(part.size()), 16);
      Put(static_cast<std::uint32_t>(~part.size() & 0xFFFFU), 16);
      Flush();
      m_Out += part;
    } while (!bytes.empty());
  }

  std::string_view                      m_Bytes;
  std::string                           m_Out;
  std::uint64_t                         m_Held = 0;
  unsigned                              m_HeldBits = 0;
  std::vector<Token>                    m_Tokens;
  std::uint64_t                         m_Symbols = 0;
  std::array<std::uint32_t, kLiterals>  m_LiteralCounts{};
  std::array<std::uint32_t, kDistances> m_DistanceCounts{};
};

} // namespace

std::string
Deflate(std::string_view bytes)
{
  return Packer(bytes).Take();
}

bool
Inflate(std::string_view packed, char * to, std::size_t size)
{
  auto       room = static_cast<uLongf>(size);
  const auto from = reinterpret_cast<const Bytef *>(packed.data());
  return uncompress(reinterpret_cast<Bytef *>(to), &room, from, static_cast<uLong>(packed.size())) == Z_OK &&
         room == size;
}

} // namespace voxelcore
