//! What the window has to say, shown beside the work without stopping anybody, and all that it has said.

use std::collections::VecDeque;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Goes away by itself, as a rule.
    Info,
    /// Stays until dismissed.
    Warning,
    /// Stays until dismissed.
    Error,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    pub id: u64,
    pub level: Level,
    pub text: String,
    /// Time of the window's clock at which it goes away, s.
    pub until: Option<f64>,
}

/// How long an information stays, s: enough to read two lines.
const INFO_STAYS_S: f64 = 6.0;
/// More than this many push the rest of the panel away: the oldest go.
const AT_MOST: usize = 4;
/// Messages of the log; the oldest go.
const LOGGED: usize = 500;

#[derive(Clone, Debug, Default)]
pub struct Messages {
    list: Vec<Message>,
    /// What was said, and when on the window's clock, s.
    log: VecDeque<(f64, Message)>,
    next_id: u64,
    now: f64,
}

impl Messages {
    pub fn info(&mut self, text: impl Into<String>) {
        self.add(Level::Info, text.into(), Some(self.now + INFO_STAYS_S));
    }

    /// What somebody waited for: it stays until it is dismissed.
    pub fn done(&mut self, text: impl Into<String>) {
        self.add(Level::Info, text.into(), None);
    }

    pub fn warning(&mut self, text: impl Into<String>) {
        self.add(Level::Warning, text.into(), None);
    }

    pub fn error(&mut self, text: impl Into<String>) {
        self.add(Level::Error, text.into(), None);
    }

    pub fn dismiss(&mut self, id: u64) {
        self.list.retain(|m| m.id != id);
    }

    /// Dismisses what does not hold any more.
    pub fn take_back(&mut self, text: &str) {
        self.list.retain(|m| m.text != text);
    }

    pub fn list(&self) -> &[Message] {
        &self.list
    }

    /// Everything that was said and when, s, the oldest first.
    pub fn log(&self) -> impl DoubleEndedIterator<Item = &(f64, Message)> {
        self.log.iter()
    }

    /// Moves the clock on and drops what is over.
    pub fn tick(&mut self, now: f64) {
        self.now = now;
        self.list.retain(|m| m.until.is_none_or(|until| until > now));
    }

    /// Seconds until the next one goes away.
    pub fn next_change_s(&self) -> Option<f64> {
        self.list.iter().filter_map(|m| m.until).map(|until| until - self.now).min_by(f64::total_cmp)
    }

    fn add(&mut self, level: Level, text: String, until: Option<f64>) {
        // Said again: once is enough, but it stays longer.
        self.list.retain(|m| m.text != text);
        let message = Message { id: self.next_id, level, text, until };
        self.log.push_back((self.now, message.clone()));
        if self.log.len() > LOGGED {
            self.log.pop_front();
        }
        self.list.push(message);
        self.next_id += 1;
        if self.list.len() > AT_MOST {
            self.list.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn information_goes_away_and_errors_stay() {
        let mut messages = Messages::default();
        messages.info("saved");
        messages.error("no");
        messages.error("no");
        assert_eq!(messages.list().len(), 2);
        messages.tick(INFO_STAYS_S + 1.0);
        assert_eq!(messages.list().len(), 1);
        let id = messages.list()[0].id;
        messages.dismiss(id);
        assert!(messages.list().is_empty());
        messages.warning("nothing was found");
        messages.take_back("nothing was found");
        assert!(messages.list().is_empty());
        let said: Vec<&str> = messages.log().map(|(_, message)| message.text.as_str()).collect();
        assert_eq!(said, ["saved", "no", "no", "nothing was found"]);
    }
}
