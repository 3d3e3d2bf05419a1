//! What a master of I2C is told, and what it answers.

use tilewright_hdl::{bit, bits, codes, one_of, record};

codes! {
    /// What an [`I2cMaster`](crate::I2cMaster) is told to do.
    ///
    /// ```
    /// # use tilewright_blocks::I2cAction;
    /// # use tilewright_hdl::Codes;
    /// assert_eq!(I2cAction::from_number(3), Some(I2cAction::Stop));
    /// ```
    pub enum I2cAction {
        /// Sends a START. Within a transfer it is a repeated START.
        Start,
        /// Sends a byte, and looks whether it is acknowledged.
        Write,
        /// Receives a byte, and acknowledges it unless it is the last.
        Read,
        /// Sends a STOP.
        Stop,
    }

    /// What became of a command of an [`I2cMaster`](crate::I2cMaster).
    ///
    /// ```
    /// # use tilewright_blocks::I2cResult;
    /// # use tilewright_hdl::Codes;
    /// assert_eq!(I2cResult::Nack.code(), 1);
    /// ```
    pub enum I2cResult {
        /// It is done; a byte that was sent is acknowledged.
        Done,
        /// The byte is sent, but no slave acknowledges it.
        Nack,
        /// The master does not have the bus, or has lost it to another master. It has done nothing more.
        Lost,
    }
}

record! {
    /// A command for an [`I2cMaster`](crate::I2cMaster).
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// let (slave, register) = (0x50, 7);
    /// let read_it = [
    ///     I2cCommand::START,
    ///     I2cCommand::write(slave << 1),
    ///     I2cCommand::write(register),
    ///     I2cCommand::START,
    ///     I2cCommand::write(slave << 1 | 1),
    ///     I2cCommand::LAST_READ,
    ///     I2cCommand::STOP,
    /// ];
    /// # assert_eq!(read_it[1].byte, 0xa0);
    /// ```
    pub struct I2cCommand {
        /// What to do.
        action: one_of::<I2cAction>(),
        /// The byte of a `Write`.
        byte: bits(8),
        /// A `Read` is the last: its byte is not acknowledged, so the slave stops sending.
        last: bit(),
    }

    /// The answer of an [`I2cMaster`](crate::I2cMaster) to a command.
    ///
    /// ```
    /// # use tilewright_blocks::{I2cAnswer, I2cResult};
    /// # use tilewright_hdl::Codes;
    /// let refused = I2cAnswer { result: I2cResult::Nack.code(), byte: 0xa0 };
    /// assert_eq!(refused.result, 1);
    /// ```
    pub struct I2cAnswer {
        /// What became of the command.
        result: one_of::<I2cResult>(),
        /// The byte that was received. It means something after a `Read` that is `Done`.
        byte: bits(8),
    }
}

impl I2cCommand<u64> {
    /// A START.
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// assert_eq!(I2cCommand::START.action, 0);
    /// ```
    pub const START: I2cCommand<u64> = I2cCommand { action: 0, byte: 0, last: 0 };
    /// Receives a byte and acknowledges it.
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// assert_eq!(I2cCommand::READ.last, 0);
    /// ```
    pub const READ: I2cCommand<u64> = I2cCommand { action: 2, byte: 0, last: 0 };
    /// Receives the last byte.
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// assert_eq!(I2cCommand::LAST_READ.last, 1);
    /// ```
    pub const LAST_READ: I2cCommand<u64> = I2cCommand { action: 2, byte: 0, last: 1 };
    /// A STOP.
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// assert_eq!(I2cCommand::STOP.action, 3);
    /// ```
    pub const STOP: I2cCommand<u64> = I2cCommand { action: 3, byte: 0, last: 0 };

    /// Sends a byte.
    ///
    /// ```
    /// # use tilewright_blocks::I2cCommand;
    /// assert_eq!(I2cCommand::write(0xa5), I2cCommand { action: 1, byte: 0xa5, last: 0 });
    /// ```
    pub const fn write(byte: u64) -> I2cCommand<u64> {
        I2cCommand { action: 1, byte, last: 0 }
    }
}
