//! Counts of what has run, which are added up and printed.

/// Declares a struct of counts, each with its name in words. It adds up, and prints `NAME: COUNT` one after another.
macro_rules! tally {
    (
        $(#[$about:meta])*
        pub struct $name:ident { $($(#[$what:meta])* $count:ident: $words:literal),* $(,)? }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
        pub struct $name { $($(#[$what])* pub $count: u64),* }

        impl std::ops::AddAssign for $name {
            fn add_assign(&mut self, other: $name) {
                $(self.$count += other.$count;)*
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                let counts = [$(($words, self.$count)),*];
                let counts: Vec<String> = counts.iter().map(|(words, count)| format!("{words}: {count}")).collect();
                f.write_str(&counts.join(", "))
            }
        }

        impl $name {
            /// What was printed, in the last line of a text.
            #[allow(dead_code, reason = "not every tally comes from another process")]
            fn read(text: &str) -> Option<$name> {
                let line = text.lines().last()?;
                let mut counts = line.split(", ").map(|part| part.rsplit_once(": ")?.1.parse().ok());
                let tally = $name { $($count: counts.next()??),* };
                (tally.to_string() == line).then_some(tally)
            }
        }
    };
}

pub(crate) use tally;
