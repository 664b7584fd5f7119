//! Streams: families of controllers that a host tells every step, over a line, at its time.
//!
//! A [`Stream`] knows the words of one family and nothing of time, files or ports. [`programs`] makes the files of it; a live drive asks it for
//! one command after the other.

use super::framing::Framing;
use super::machine::Machine;
use super::program::Program;
use super::trajectory::Trajectory;

/// One step of one winch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    pub winch: usize,
    /// Cable on the spool at its beginning and at its end, mm.
    pub from_mm: f64,
    pub to_mm: f64,
    pub duration_s: f64,
}

/// The commands of a family for one machine. Winches count from 0, lengths are mm of cable from the zero that [`Stream::setup`] sets.
pub trait Stream: Send + Sync {
    fn machine(&self) -> &Machine;

    fn framing(&self) -> Framing;

    /// Whether all winches move by one command; otherwise each has commands of its own.
    fn moves_together(&self) -> bool {
        false
    }

    /// Moves that the controller keeps in a queue before it begins.
    fn queued(&self) -> usize {
        0
    }

    /// A line of the file that controllers skip; none where they skip nothing.
    fn comment(&self, _text: &str) -> Option<String> {
        None
    }

    /// Once, at rest, with cables just slack: this is zero, and these are the limits.
    fn setup(&self) -> Vec<String>;

    /// Before every motion: motors on, ready to follow.
    fn ready(&self) -> Vec<String>;

    /// Loads a move that [`Stream::go`] starts.
    fn load(&self, step: &Move) -> Vec<String>;

    /// Starts the moves of one step: of one winch, or of all where they move together.
    fn go(&self, steps: &[Move]) -> Vec<String>;

    /// Loads the way back to zero, slowly.
    fn load_home(&self) -> Vec<String>;

    /// Starts it.
    fn go_home(&self) -> Vec<String>;

    /// Motors off, at rest.
    fn off(&self) -> Vec<String>;

    /// Brings the controllers to listen when a line was just opened, or they were switched off. Nobody awaits replies.
    fn wake(&self) -> Vec<String> {
        Vec::new()
    }

    /// Whether an answer to [`Stream::locate`] says that the controllers sleep.
    fn sleeps(&self, _reply: &str) -> bool {
        false
    }

    /// After [`Stream::wake`], where they slept.
    fn unlock(&self) -> Vec<String> {
        Vec::new()
    }

    /// Stops all motors at once, before they are switched off one by one. Nobody awaits replies.
    fn halt(&self) -> Vec<String> {
        Vec::new()
    }

    /// Motors off, whatever they do.
    fn confirm_halt(&self) -> Vec<String> {
        self.off()
    }

    /// Time beyond [`Machine::stopping_s`] that the way to zero may take, s.
    fn home_s(&self) -> f64 {
        0.0
    }

    /// Asks where a winch is.
    fn locate(&self, winch: usize) -> String;

    /// The answer to that, mm; none where it is something else.
    fn place_mm(&self, winch: usize, reply: &str) -> Option<f64>;

    /// Whether a reply says that a command was taken; if not, what it says.
    ///
    /// # Errors
    /// The reply in words.
    fn taken(&self, command: &str, reply: &str) -> Result<(), String>;

    /// Whether a reply belongs to no command: a greeting, a note that a position was reached.
    fn is_aside(&self, _reply: &str) -> bool {
        false
    }

    /// The winch that a command is for; none where one controller has all of them.
    fn addressed(&self, _command: &str) -> Option<usize> {
        None
    }

    /// What a controller is called on the line, for people.
    fn address(&self, winch: usize) -> String {
        format!("node {}", winch + 1)
    }
}

/// The three programs of a stream.
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    /// Once, at rest: sets zero and limits.
    pub setup: Program,
    /// As often as one likes; never sets zero.
    pub motion: Program,
    /// To zero, wait, off.
    pub stop: Program,
}

/// The programs that play a trajectory. Every step of the motion loads the next position of all winches, moving or not, and then starts them; without a
/// motion there is a single step to where the toy is. `remarks` stand in the heads of all three where the family knows comments.
pub fn programs(stream: &dyn Stream, trajectory: &Trajectory, remarks: &[String]) -> Programs {
    let begin = |part: &str| {
        let mut program = Program::new(stream.framing());
        let head = std::iter::once(part).chain(remarks.iter().map(String::as_str));
        program.extend(head.filter_map(|text| stream.comment(text)));
        program
    };
    let mut setup =
        begin("setup: once, with the plushie at rest and its cables just slack. It makes this position zero.");
    setup.extend(stream.setup());
    let mut motion = begin("motion: as often as you like, from the rest position.");
    motion.extend(stream.ready());
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    for k in 0..times.len().saturating_sub(1).max(1) {
        let next = (k + 1).min(times.len() - 1);
        let step = |winch: usize| Move {
            winch,
            from_mm: lengths[k][winch],
            to_mm: lengths[next][winch],
            duration_s: times[next] - times[k],
        };
        let steps: Vec<Move> = (0..trajectory.winches.len()).map(step).collect();
        motion.begin_step(times[k]);
        // All targets first: the winches then start as nearly together as the line allows.
        motion.extend(steps.iter().flat_map(|step| stream.load(step)));
        if stream.moves_together() {
            motion.extend(stream.go(&steps));
        } else {
            motion.extend(steps.iter().flat_map(|step| stream.go(&[*step])));
        }
    }
    let mut stop = begin("stop: slowly back to zero, motors off.");
    stop.extend(stream.load_home());
    // The clock starts with the first winch that moves.
    stop.begin_step(0.0);
    stop.extend(stream.go_home());
    stop.begin_step(stream.machine().stopping_s());
    stop.extend(stream.off());
    Programs { setup, motion, stop }
}
