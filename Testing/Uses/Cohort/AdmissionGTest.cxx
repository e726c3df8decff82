#include "voxelcore/Cohort/Admission.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <future>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace voxelcore
{
namespace
{

/** A line as a batch opens it: the case's end named in the environment. */
class Line
{
public:
  Line()
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0)
    {
      throw std::runtime_error("no sockets here");
    }
    m_Batch = ends[0];
    m_Case = ends[1];
    setenv(kAdmissionVariable, std::to_string(m_Case).c_str(), 1);
  }
  ~Line()
  {
    HangUp();
    close(m_Case);
    unsetenv(kAdmissionVariable);
  }

  /** Waits for what the case asks for. */
  double
  Asked() const
  {
    char       text[64] = {};
    const auto size = recv(m_Batch, text, sizeof text - 1, 0);
    return size > 0 ? std::stod(text) : -1;
  }
  void
  Grant() const
  {
    EXPECT_EQ(send(m_Batch, "+", 1, MSG_NOSIGNAL), 1);
  }
  void
  HangUp()
  {
    if (m_Batch >= 0)
    {
      close(m_Batch);
    }
    m_Batch = -1;
  }

private:
  int m_Batch = -1;
  int m_Case = -1;
};

const auto kNever = [] { return false; };

TEST(Admission, AProcessThatNoBatchStartedNeedsNone)
{
  unsetenv(kAdmissionVariable);
  EXPECT_FALSE(AdmissionFromEnvironment(kNever));
  for (const char * text : { "", "no number", "5abc" })
  {
    setenv(kAdmissionVariable, text, 1);
    EXPECT_FALSE(AdmissionFromEnvironment(kNever)) << text;
  }
  unsetenv(kAdmissionVariable);
}

TEST(Admission, ACaseAsksForItsMemoryAndWaitsUntilItIsGranted)
{
  const Line line;
  const auto admit = AdmissionFromEnvironment(kNever);
  ASSERT_TRUE(admit);
  auto waiting = std::async(std::launch::async, [&] { admit(1234.5); });
  EXPECT_DOUBLE_EQ(line.Asked(), 1234.5);
  EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(150)), std::future_status::timeout) << "nothing is granted yet";
  line.Grant();
  EXPECT_NO_THROW(waiting.get());
}

TEST(Admission, WaitingEndsWhenItIsToldToStop)
{
  const Line line;
  int        asked = 0;
  const auto admit = AdmissionFromEnvironment([&] { return ++asked == 2; });
  EXPECT_THROW(admit(1), Cancelled);
  EXPECT_EQ(asked, 2);
}

TEST(Admission, ABatchThatIsGoneIsAnError)
{
  Line       line;
  const auto admit = AdmissionFromEnvironment(kNever);
  auto       waiting = std::async(std::launch::async, [&] { admit(7); });
  EXPECT_DOUBLE_EQ(line.Asked(), 7);
  line.HangUp();
  EXPECT_THROW(waiting.get(), Error) << "while it waits";
  EXPECT_THROW(admit(7), Error) << "before it asks";
}

} // namespace
} // namespace voxelcore
