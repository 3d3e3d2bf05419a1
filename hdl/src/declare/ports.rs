//! The ports of a block and the fields of a record: what is written for one becomes its type and its width.

/// Reads ports or fields in sequence, for [`block!`](crate::block!) and [`record!`](crate::record!).
///
/// `[@ports of] [done] [to read] state`: each step moves one from `to read` to `done`, as its documentation, name,
/// type and, if given, width. At the end, the clauses of the block continue with `state`, or the record is declared.
#[doc(hidden)]
#[macro_export]
macro_rules! block_ports {
    // The ports of a bundle, in sequence: the documentation, name, type and, if given, width of each.
    (@ports [record $($of:tt)+] [$($done:tt)*] [$field:tt: $($record:ident =)? _ $(, $($more:tt)*)?]) => {
        $crate::wrong_field! { HasWidth $field }
        $crate::block_ports! { @ports [record $($of)+] [$($done)* {[] $field [T] [$crate::bit()]}] [$($($more)*)?] }
    };
    (@ports [record $($of:tt)+] $done:tt [#[$($said:tt)*] $field:tt: $($record:ident =)? _ $($more:tt)*]) => {
        $crate::block_ports! { @ports [record $($of)+] $done [$field: _ $($more)*] }
    };
    (@ports $of:tt [$($done:tt)*] [$(#[$($said:tt)*])* $port:ident: _ $(, $($more:tt)*)?] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {[$([$($said)*])*] $port [T] []}] [$($($more)*)?] $($state)* }
    };
    // A record declared together with its widths becomes a bundle of its own.
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $vis:vis struct $record:ident {
            $($(#[$($field_said:tt)*])* $field:ident: $width:expr),* $(,)?
        } $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::bundle! {
            $(#[$($said)*])*
            $vis struct $record<T> { $($(#[$($field_said)*])* $vis $field: T),* }
        }
        $crate::block_ports! {
            @ports $of [$($done)* {
                [$([$($said)*])*] $port [$record<T>] [$record { $($field: $width),* } $(.on($clock))?]
            }]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: stream($vis:vis struct $record:ident {
            $($(#[$($field_said:tt)*])* $field:ident: $width:expr),* $(,)?
        }) $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::bundle! {
            $(#[$($said)*])*
            $vis struct $record<T> { $($(#[$($field_said)*])* $vis $field: T),* }
        }
        $crate::block_ports! {
            @stream [$record { $($field: $width),* }] [$($clock)?] [] [$([$($said)*])*] $port
            @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: stream($($payload:tt)*) $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @stream [$($payload)*] [$($clock)?] [] [$([$($said)*])*] $port @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [stream($($payload:tt)*) $(.on($clock:expr))? $(; $count:expr)?] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @stream [$($payload)*] [$($clock)?] [list $($count)?] [$([$($said)*])*] $port
            @ports $of [$($done)*] [$($($more)*)?] $($state)*
        }
    };
    // A list of records whose widths follow from the name, or from the name and parameters.
    (@ports $of:tt $done:tt [
        $(#[$($said:tt)*])* $port:ident: [$record:ident $(::widths($($given:tt)*))? $(.on($clock:expr))?; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of $done [
                $(#[$($said)*])*
                $port: [$record = $crate::block_ports!(@widths $record $(($($given)*))?) $(.on($clock))?; $count] $(, $($more)*)?
            ]
            $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident = _ $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] []}] [$($($more)*)?] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident = $widths:expr $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] [$widths]}] [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: $record:ident { $($fields:tt)* } $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [$record<T>] [$record { $($fields)* } $(.on($clock))?]}]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$record:ident = $widths:expr; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<$record<T>>] [$crate::list($widths, $count)]}]
            [$($($more)*)?] $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$record:ident] = _ $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<$record<T>>] []}] [$($($more)*)?] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [
        $(#[$($said:tt)*])* $port:ident: [$width:expr; $count:expr] $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of [$($done)* {[$([$($said)*])*] $port [Vec<T>] [$crate::list($width, $count)]}]
            [$($($more)*)?] $($state)*
        }
    };
    // A record whose widths follow from its name, or from its name and parameters. rustc reports mistakes at a name
    // that is matched as `tt`, and one that is matched as `ident` is no other width.
    (@ports $of:tt $done:tt [
        $(#[$($said:tt)*])* $port:ident: $record:tt $(::widths($($given:tt)*))? $(.on($clock:expr))? $(, $($more:tt)*)?
    ] $($state:tt)*) => {
        $crate::block_ports! {
            @name $record $record [$(($($given)*))?] [$(.on($clock))?] [$([$($said)*])*] $port [$($($more)*)?]
            @ports $of $done $($state)*
        }
    };
    (@ports $of:tt [$($done:tt)*] [$(#[$($said:tt)*])* $port:ident: $width:expr $(, $($more:tt)*)?] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {[$([$($said)*])*] $port [T] [$width]}] [$($($more)*)?] $($state)* }
    };
    (@ports [record $($of:tt)+] [$($done:tt)*] []) => { $crate::record! { @declare $($of)+ $($done)* } };
    // A field of `record!` or a port that is written in another way.
    (@ports $of:tt $done:tt [$(#[$($said:tt)*])* pub $port:tt: $($more:tt)*] $($state:tt)*) => {
        $crate::wrong_field! { HasNoPub $port }
        $crate::block_ports! { @ports $of $done [$(#[$($said)*])* $port: $($more)*] $($state)* }
    };
    (@ports $of:tt $done:tt [$(#[$($said:tt)*])* pub ($($scope:tt)*) $($port:tt)*] $($state:tt)*) => {
        $crate::block_ports! { @ports $of $done [$(#[$($said)*])* pub $($port)*] $($state)* }
    };
    (@ports $of:tt $done:tt [#[$($said:tt)*] $($port:tt)+] $($state:tt)*) => {
        $crate::block_ports! { @ports $of $done [$($port)+] $($state)* }
    };
    (@ports $of:tt [$($done:tt)*] [$port:tt $($more:tt)*] $($state:tt)*) => {
        $crate::wrong_field! { IsField $port }
        $crate::block_ports! { @ports $of [$($done)* {[] $port [T] [$crate::bit()]}] [] $($state)* }
    };
    (@ports [in $($of:tt)+] $ports:tt [] $block:tt $latency:tt $source:tt [] $out:tt $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source [[$($of)+] $ports] $out $($rest)* }
    };
    (@ports [out $($of:tt)+] $ports:tt [] $block:tt $latency:tt $source:tt $in:tt [] $($rest:tt)*) => {
        $crate::block! { @clauses $block $latency $source $in [[$($of)+] $ports] $($rest)* }
    };

    // A stream: its type by that of its payload, and its widths if given.
    (@stream [_] [] $($port:tt)*) => { $crate::block_ports! { @put [T] [] $($port)* } };
    (@stream [$record:ident $(::widths($($given:tt)*))?] $clock:tt $($port:tt)*) => {
        $crate::block_ports! { @stream [$record = $crate::block_ports!(@widths $record $(($($given)*))?)] $clock $($port)* }
    };
    (@stream [$record:ident = _] [] $($port:tt)*) => { $crate::block_ports! { @put [$record<T>] [] $($port)* } };
    (@stream [$record:ident = $widths:expr] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block_ports! { @put [$record<T>] [$crate::stream($widths) $(.on($clock))?] $($port)* }
    };
    (@stream [$record:ident { $($fields:tt)* }] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block_ports! { @put [$record<T>] [$crate::stream($record { $($fields)* }) $(.on($clock))?] $($port)* }
    };
    (@stream [$width:expr] [$($clock:expr)?] $($port:tt)*) => {
        $crate::block_ports! { @put [T] [$crate::stream($width) $(.on($clock))?] $($port)* }
    };
    (@put [$($payload:tt)*] [$($widths:expr)?] [] $said:tt $port:ident @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {$said $port [$crate::Stream<$($payload)*, T>] [$($widths)?]}] $($state)* }
    };
    (@put [$($payload:tt)*] [$($widths:expr)?] [list $($count:expr)?] $said:tt $port:ident @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of
            [$($done)* {$said $port [Vec<$crate::Stream<$($payload)*, T>>] [$($crate::list($widths, $count))?]}]
            $($state)*
        }
    };

    (@name $is:ident $record:tt [$($given:tt)?] [$($on:tt)*] $said:tt $port:ident $more:tt @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block_ports! {
            @ports $of [$($done)* {$said $port [$record<T>] [$crate::block_ports!(@widths $record $($given)?) $($on)*]}] $more $($state)*
        }
    };
    (@name $width:tt $same:tt [] [$($on:tt)*] $said:tt $port:ident $more:tt @ports $of:tt [$($done:tt)*] $($state:tt)*) => {
        $crate::block_ports! { @ports $of [$($done)* {$said $port [T] [$width $($on)*]}] $more $($state)* }
    };
    (@widths $record:tt) => {
        <$record as $crate::Record>::widths()
    };
    (@widths $record:tt ($($given:tt)*)) => {
        $record::widths($($given)*)
    };
}
