//! Transmission of a program over a link: commands one by one, each with its reply, every step at its time.

use super::link::{Link, LinkError, Reply};
use super::program::Program;

/// Longest wait for a reply, s: a command and its reply take some 10 ms at 9600 baud, and USB adapters add 16.
pub const PATIENCE_S: f64 = 0.5;
/// The answer of motors to a command that they have taken.
const TAKEN: &str = "OK";

/// The outcome of a transmission.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sent {
    pub commands: usize,
    /// How far behind its time the latest step began, s: more than nothing where the line is too slow for the program.
    pub latest_s: f64,
}

/// Opens a link and sends a program: the setup at once, every step when the link's clock has come to it. Its first step begins
/// right after the setup, whatever its time.
///
/// # Errors
/// A line that is not there or breaks, and a motor that does not answer within `patience_s` or refuses a command; the motors then
/// stay where the commands before have sent them.
pub fn transmit(program: &Program, link: &mut dyn Link, patience_s: f64) -> Result<Sent, LinkError> {
    link.open()?;
    let mut sent = Sent::default();
    for command in program.setup() {
        send(link, command, patience_s)?;
        sent.commands += 1;
    }
    let mut first = None;
    for (time_s, commands) in program.steps() {
        let (began_s, first_s) = *first.get_or_insert((link.now_s(), time_s));
        let due_s = began_s + (time_s - first_s);
        link.wait_until(due_s)?;
        sent.latest_s = sent.latest_s.max(link.now_s() - due_s);
        for command in commands {
            send(link, command, patience_s)?;
            sent.commands += 1;
        }
    }
    Ok(sent)
}

/// Sends a command and awaits its reply.
fn send(link: &mut dyn Link, command: &str, patience_s: f64) -> Result<(), LinkError> {
    link.send(command)?;
    match link.read(patience_s)? {
        Reply::OneWay => Ok(()),
        Reply::Line(reply) if reply == TAKEN => Ok(()),
        Reply::Line(reply) => Err(LinkError::Refused { command: command.into(), reply }),
        Reply::Nothing => Err(LinkError::NoReply { command: command.into(), patience_s }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::links::{FileLink, SimulatedLink};
    use super::*;

    /// One step every `interval_s`: `nodes` drives by 500 counts each.
    fn program(nodes: usize, steps: usize, interval_s: f64) -> Program {
        let mut program = Program::new("\r");
        for node in 1..=nodes {
            for command in ["ENCRES2048", "SP5000", "AC200", "DEC200", "HO0", "EN"] {
                program.push(format_args!("{node}{command}"));
            }
        }
        for step in 1..=steps {
            program.begin_step(3.0 + interval_s * step as f64);
            (1..=nodes).for_each(|node| program.push(format_args!("{node}LA{}", 10_000 + 500 * step)));
            (1..=nodes).for_each(|node| program.push(format_args!("{node}M")));
        }
        program
    }

    #[test]
    fn a_file_holds_what_was_sent() {
        let program = program(2, 3, 0.5);
        let mut link = FileLink::new(program.terminator);
        let sent = transmit(&program, &mut link, PATIENCE_S).unwrap();
        assert_eq!(sent, Sent { commands: 2 * 6 + 3 * 4, latest_s: 0.0 });
        assert!((link.now_s() - 1.0).abs() < 1e-9);
        assert_eq!(link.into_bytes(), FileLink::of(&program).into_bytes());
    }

    #[test]
    fn drives_arrive_and_the_line_keeps_pace_if_it_can() {
        // A step of a winch is 20 bytes with its replies: 21 ms at 9600 baud.
        let mut drives = SimulatedLink::new(3);
        let sent = transmit(&program(3, 20, 0.1), &mut drives, PATIENCE_S).unwrap();
        assert_eq!(sent.latest_s, 0.0);
        assert!(drives.settle(10.0));
        assert_eq!([1, 2, 3, 4].map(|node| drives.position(node)), [Some(20_000), Some(20_000), Some(20_000), None]);
        let late = transmit(&program(3, 20, 0.05), &mut SimulatedLink::new(3), PATIENCE_S).unwrap();
        let step_s = 3.0 * 20.0 * 10.0 / 9600.0;
        assert!((late.latest_s - 19.0 * (step_s - 0.05)).abs() < 1e-9, "{}", late.latest_s);
    }

    #[test]
    fn a_drive_runs_a_trapezoid() {
        let mut drive = SimulatedLink::new(1);
        drive.open().unwrap();
        for command in ["1ENCRES1000", "1SP600", "1AC20", "1DEC40", "1EN", "1LA10000", "1M"] {
            send(&mut drive, command, PATIENCE_S).unwrap();
        }
        // 10 rev/s after 0.5 s (2.5 revolutions), 0.25 s to stop (1.25), the rest at full speed: 1.375 s in all.
        // The reply to M, four bytes, came while it moved.
        let start = drive.now_s() - 4.0 * 10.0 / 9600.0;
        drive.wait_until(start + 0.5).unwrap();
        assert!((drive.position(1).unwrap() - 2500).abs() < 20, "{:?}", drive.position(1));
        assert!(drive.settle(10.0));
        assert!((drive.now_s() - start - 1.375).abs() < 0.02, "{}", drive.now_s() - start);
        assert_eq!(drive.position(1), Some(10_000));
    }

    #[test]
    fn what_motors_refuse_ends_the_transmission() {
        let refused = |command: &str, nodes: usize| {
            let mut program = Program::new("\r");
            program.push(format_args!("{command}"));
            transmit(&program, &mut SimulatedLink::new(nodes), PATIENCE_S).unwrap_err().to_string()
        };
        assert!(refused("1FLY", 1).contains("Unknown command"));
        assert!(refused("1SP-4", 1).contains("Invalid parameter"));
        assert!(refused("1M", 1).contains("not available"), "the motor is off");
        assert!(refused("2EN", 1).contains("did not answer"));
        assert!(matches!(SimulatedLink::new(1).send("1EN"), Err(LinkError::Closed)));
    }
}
